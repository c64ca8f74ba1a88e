#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// `touchstone scan`: fuses what the fixed camera sees, saves it and says so on standard output. Throws
/// Error; a signal to end is one, and leaves no file.
ExitStatus scan_command(const ScanOptions& options);

}  // namespace touchstone
