#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// Back to the first start: removes what a table wrote where its configuration says - scan, calibrations,
/// painting, each with the one kept before it, reports of faults - and says so line by line on standard
/// output. The configuration stays. Throws Error{io_error} where something cannot be removed, once the rest
/// is.
ExitStatus reset_command(const ResetOptions& options);

}  // namespace touchstone
