#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/shared_types.h"

namespace touchstone {

/// A Kinect v1's own calibration: the plane on which its reference pattern was taken. The defaults are the
/// nominal ones.
struct ZeroPlane {
    double emitter_baseline_cm = 7.5;  ///< infrared camera to projector
    double color_baseline_cm = 2.3;    ///< infrared camera to colour camera
    double distance_mm = 120.0;        ///< in the units of the pixel size: their ratio is the focal length
    double pixel_size_mm = 0.1042;     ///< at 1280 pixels a row
    double constant_shift = 200.0;     ///< of the disparity, in units of four
};

inline constexpr std::size_t raw_depth_values = 2048;
inline constexpr std::uint16_t no_raw_depth = 2047;
inline constexpr std::uint16_t farthest_depth_mm = 10000;

/// A raw 11-bit disparity as depth in mm, rounded; 0 where it is invalid, beyond 10 m or beyond infinity.
std::uint16_t raw_to_mm(std::uint16_t raw, const ZeroPlane& plane);

using DepthTable = std::array<std::uint16_t, raw_depth_values>;
DepthTable depth_table(const ZeroPlane& plane);

/// Of the depth picture, 640x480.
Intrinsics depth_intrinsics(const ZeroPlane& plane);

/// Nominal, of the colour picture, 640x480; the depth picture's too once it is registered to colour.
Intrinsics color_intrinsics();

}  // namespace touchstone
