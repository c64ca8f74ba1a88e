#pragma once

#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

namespace touchstone {

/// One frame of a depth camera. Camera frame: x right, y down, z forward; depth is z, not the length of the
/// ray.
struct DepthFrame {
    int index = 0;                   ///< the file's number for sequences, else counted by the source
    std::uint64_t timestamp_us = 0;  ///< of the source's clock
    int width_px = 0;
    int height_px = 0;
    Intrinsics intrinsics{};
    std::vector<std::uint16_t> depth_mm;  ///< row-major, 0 = invalid
    std::vector<std::uint8_t> color_rgb;  ///< 3 bytes a pixel, same size as depth, or empty
};

}  // namespace touchstone
