#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/shared_types.h"
#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/pixel_region.hpp"

namespace touchstone {

/// Mean depths of a part of the picture, row by row in the box, metres; 0 where the part does not reach.
struct DepthPatch {
    PixelRegion box;
    std::vector<float> depth_m;
    std::vector<std::uint8_t> samples;  ///< how many frames each mean is of

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>((y - box.y0) * box.width_px() + x - box.x0);
    }
    /// 0 outside the box, too.
    float at(int x, int y) const { return box.contains(x, y) ? depth_m[index(x, y)] : 0.0f; }
};

/// One frame as the object stages see it: maps with the camera's shape, mapped for the call.
struct ObjectFrame {
    Intrinsics intrinsics{};
    MapShape shape{};
    std::span<const float> live_m;            ///< as measured
    std::span<const float> predicted_m;       ///< the background
    std::span<const int> labels;              ///< of the components, -1 = none
    std::span<const std::uint8_t> rejection;  ///< RejectionCode
    std::span<const std::uint8_t> settled;    ///< not 0 on and around what was put down; empty: there is none
    std::span<const ForegroundComponent> components;
    std::span<const Eigen::Vector2f> touches_px;  ///< fingers in contact
    std::uint64_t timestamp_us = 0;
};

/// So many standard deviations of a depth that a surface facing the camera has.
inline float depth_tolerance_m(const SensorNoise& noise, float quantisation_per_m, float sigmas, float z_m) {
    const float sigma_m =
        noise.constant_m + noise.quadratic * (z_m - noise.offset_m) * (z_m - noise.offset_m);
    return sigmas * std::hypot(sigma_m, quantisation_per_m * z_m * z_m);
}

}  // namespace touchstone
