#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "kernels/shared_types.h"

namespace touchstone::test {

/// How a structured-light sensor spoils exact depths: each column's disparity is shifted, disparity has noise
/// that is alike over `blob_px`, and it is rounded to steps; depth is what the rounded disparity stands for.
struct StructuredLight {
    float step_per_m = 0.0029f;  ///< one step of disparity in 1/z: a Kinect v1's 1/8 px
    float sigma_steps = 0.55f;
    int blob_px = 3;
    float lost_share = 0.002f;              ///< of pixels without depth
    std::vector<float> column_shift_steps;  ///< empty: none
};

/// `depth_m`: width x height, 0 = none. Millimetres.
inline std::vector<std::uint16_t> sense(const StructuredLight& sensor, const Intrinsics& k,
                                        std::span<const float> depth_m, std::mt19937& random) {
    std::normal_distribution<float> noise_steps(0.0f, sensor.sigma_steps);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    const int blobs_per_row = k.width_px / sensor.blob_px + 1;
    std::vector<float> blobs(static_cast<std::size_t>(blobs_per_row * (k.height_px / sensor.blob_px + 1)));
    for (float& blob : blobs) blob = noise_steps(random);
    std::vector<std::uint16_t> depth_mm(depth_m.size(), 0);
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto pixel = static_cast<std::size_t>(y * k.width_px + x);
            if (depth_m[pixel] <= 0.0f || share(random) < sensor.lost_share) continue;
            const auto column = static_cast<std::size_t>(x);
            const float shift =
                column < sensor.column_shift_steps.size() ? sensor.column_shift_steps[column] : 0.0f;
            const auto blob =
                static_cast<std::size_t>(y / sensor.blob_px * blobs_per_row + x / sensor.blob_px);
            const float steps = std::round(1.0f / depth_m[pixel] / sensor.step_per_m + blobs[blob] + shift);
            const float sensed_mm = 1000.0f / (steps * sensor.step_per_m);
            depth_mm[pixel] = static_cast<std::uint16_t>(std::lround(std::clamp(sensed_mm, 0.0f, 65535.0f)));
        }
    }
    return depth_mm;
}

}  // namespace touchstone::test
