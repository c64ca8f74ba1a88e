#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// `touchstone scan`: fuses what the fixed camera sees and saves it. A signal to end leaves no file. Throws
/// Error.
ExitStatus scan_command(const ScanOptions& options);

}  // namespace touchstone
