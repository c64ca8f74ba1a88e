#pragma once

#include <string_view>

#include "platform/opencl/program.hpp"

namespace touchstone {

/// The program of one stage, such as "listing_3_raycast.cl", built from shared_types.h, device_math.h,
/// tsdf_access.h and the stage's file.
Program load_kernel_program(const Device& device, std::string_view stage_file);

}  // namespace touchstone
