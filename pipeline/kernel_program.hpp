#pragma once

#include <string_view>
#include <vector>

#include "platform/opencl/program.hpp"

namespace touchstone {

/// What every kernel file may use: shared_types.h, device_math.h, lane_math.h for 8 and for 16 lanes,
/// colour_math.h.
std::vector<ProgramSource> common_kernel_sources();

/// The program of one stage, such as "listing_3_raycast.cl", built from common_kernel_sources(),
/// tsdf_access.h, a header of the stage's own where it has one, and the stage's file.
Program load_kernel_program(const Device& device, std::string_view stage_file, std::string_view header = {});

}  // namespace touchstone
