#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// `touchstone check`: one page on standard output. Its status is success where nothing has failed. Takes
/// some seconds.
ExitStatus check_command(const CheckOptions& options);

}  // namespace touchstone
