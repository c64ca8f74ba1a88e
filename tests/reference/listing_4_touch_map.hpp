#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

/// Listing 4 (touch map) in plain C++. As in the kernel the rays are already cast, and "overlap" is the
/// signed distance along the background's normal at the foot point.
namespace touchstone::reference {

/// A picture of oriented points without padding, camera frame; depth 0 and normal 0 are invalid.
struct OrientedPicture {
    Intrinsics intrinsics{};
    std::vector<float> depth_m;
    std::vector<Eigen::Vector3f> normals_c;

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(intrinsics.width_px) +
               static_cast<std::size_t>(x);
    }
    Eigen::Vector3f ray(int x, int y) const {
        const Intrinsics& k = intrinsics;
        return {(static_cast<float>(x) - k.cx_px) / k.fx_px, (static_cast<float>(y) - k.cy_px) / k.fy_px,
                1.0f};
    }
    Eigen::Vector3f vertex(int x, int y) const { return depth_m[index(x, y)] * ray(x, y); }
    bool known(int x, int y) const {
        return x >= 0 && y >= 0 && x < intrinsics.width_px && y < intrinsics.height_px &&
               depth_m[index(x, y)] > 0.0f && normals_c[index(x, y)].squaredNorm() > 0.5f;
    }
};

struct TouchPixel {
    float height_m = UNKNOWN_HEIGHT_M;
    bool touches = false;
};

/// Signed distance of v to the background, whose surface point on the ray of v is that of pixel (x, y). A
/// tangent plane that has a point in front of the background below it belongs to something else.
inline float height_over_background(const OrientedPicture& background, int x, int y,
                                    const Eigen::Vector3f& v) {
    const Intrinsics& k = background.intrinsics;
    Eigen::Vector3f n = background.normals_c[background.index(x, y)];
    float height_m = n.dot(v - background.vertex(x, y));
    for (int i = 0; i < 2; ++i) {
        const Eigen::Vector3f foot = v - height_m * n;
        x = static_cast<int>(std::floor(foot.x() / foot.z() * k.fx_px + k.cx_px + 0.5f));
        y = static_cast<int>(std::floor(foot.y() / foot.z() * k.fy_px + k.cy_px + 0.5f));
        if (!background.known(x, y)) break;
        const Eigen::Vector3f n_foot = background.normals_c[background.index(x, y)];
        const float foot_height_m = n_foot.dot(v - background.vertex(x, y));
        if (foot_height_m <= 0.0f && height_m >= 0.0f) break;
        height_m = foot_height_m;
        n = n_foot;
    }
    return height_m;
}

/// The pixel itself or the first known one of four around it; false where none is known.
inline bool find_known(const OrientedPicture& background, int& x, int& y) {
    constexpr int hole_px = 8;
    constexpr int offsets[5][2] = {{0, 0}, {hole_px, 0}, {-hole_px, 0}, {0, hole_px}, {0, -hole_px}};
    for (const auto& offset : offsets) {
        if (!background.known(x + offset[0], y + offset[1])) continue;
        x += offset[0], y += offset[1];
        return true;
    }
    return false;
}

inline std::vector<TouchPixel> touch_map(const std::vector<float>& live_m,
                                         const std::vector<std::uint8_t>& mask,
                                         const OrientedPicture& background, const TouchMapParams& params) {
    const Intrinsics& k = background.intrinsics;
    std::vector<TouchPixel> O(live_m.size());
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {  // line 2
            const std::size_t u = background.index(x, y);
            int bx = x, by = y;
            if (live_m[u] <= 0.0f || !find_known(background, bx, by)) continue;  // lines 3, 4
            const float z = live_m[u];
            const Eigen::Vector3f V_fg = z * background.ray(x, y);                    // line 1
            const float height_m = height_over_background(background, bx, by, V_fg);  // line 5
            const float from_offset = z - params.noise.offset_m;
            const float sigma_m =
                params.noise.constant_m + params.noise.quadratic * from_offset * from_offset;
            O[u].height_m = height_m;
            const float threshold_m = params.finger_thickness_m + params.threshold_sigmas * sigma_m;
            if (height_m < threshold_m && height_m > -params.threshold_sigmas * sigma_m)  // line 6
                O[u].touches = mask[u] != 0;                                              // line 7
        }
    }
    return O;
}

}  // namespace touchstone::reference
