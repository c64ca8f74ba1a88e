#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// Words on the display, below them why the service ended last, until the time is over or a signal comes.
/// Throws Error{unavailable} where there is no such display.
ExitStatus notice_command(const NoticeOptions& options);

}  // namespace touchstone
