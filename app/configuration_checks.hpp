#pragma once

#include <vector>

#include "app/check_report.hpp"
#include "app/config.hpp"

namespace touchstone {

/// What a configuration names and this machine has not: files and folders to be read, folders to be written
/// into, a recording or a simulation as the sensor. Empty where all is there.
std::vector<CheckLine> check_named_files(const Config& config);

/// The source that the configuration names instead of a camera, opened once; nothing where it names none.
std::vector<CheckLine> check_named_source(const Config& config);

}  // namespace touchstone
