#pragma once

#include <string>
#include <vector>

namespace touchstone {

/// Names of all OpenCL devices there are, whether usable or not.
std::vector<std::string> opencl_device_names();

}  // namespace touchstone
