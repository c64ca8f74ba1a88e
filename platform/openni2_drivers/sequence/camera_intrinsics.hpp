#pragma once

#include <filesystem>

#include "kernels/shared_types.h"

namespace touchstone {

/// Reads the 3x3 matrix [fx 0 cx; 0 fy cy; 0 0 1], pixels. Throws Error{bad_data} where it is anything else.
Intrinsics read_intrinsics(const std::filesystem::path& path, int width_px, int height_px);

/// The nominal Kinect v1 (575.8 575.8 319.5 239.5 at 640x480), scaled to the picture's size.
Intrinsics default_intrinsics(int width_px, int height_px);

}  // namespace touchstone
