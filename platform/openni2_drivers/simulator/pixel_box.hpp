#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/shared_types.h"
#include "platform/openni2_drivers/simulator/geometry.hpp"

namespace touchstone::sim {

/// Columns and rows; right and bottom are not part of it.
struct PixelBounds {
    int left = 0, top = 0, right = 0, bottom = 0;
};

/// Holds every pixel whose ray can meet the ball, cut to the picture. Camera frame, metres.
inline PixelBounds bounds_of_ball(const Vec3& center_c, float radius_m, const Intrinsics& k) {
    const float nearest = center_c.z() - radius_m;
    if (nearest < 0.05F) return {0, 0, k.width_px, k.height_px};
    const auto span = [&](float along_m, float focal_px, float principal_px, int size) {
        const float low = (along_m - radius_m) / (along_m < radius_m ? nearest : center_c.z() + radius_m);
        const float high = (along_m + radius_m) / (along_m > -radius_m ? nearest : center_c.z() + radius_m);
        const float top = static_cast<float>(size);
        return std::pair{
            static_cast<int>(std::clamp(std::floor(low * focal_px + principal_px), 0.0F, top)),
            static_cast<int>(std::clamp(std::ceil(high * focal_px + principal_px) + 1.0F, 0.0F, top))};
    };
    const auto [left, right] = span(center_c.x(), k.fx_px, k.cx_px, k.width_px);
    const auto [above, below] = span(center_c.y(), k.fy_px, k.cy_px, k.height_px);
    return {left, above, right, below};
}

}  // namespace touchstone::sim
