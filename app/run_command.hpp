#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// `touchstone run`: until the source ends, the wanted frames are done, the window is closed or a signal asks
/// to end.
ExitStatus run_command(const RunOptions& options);

}  // namespace touchstone
