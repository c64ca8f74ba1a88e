#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "kernels/shared_types.h"

namespace touchstone::test {

/// Depth along the ray K^-1 [u, 1] at which it meets a surface, in metres; 0 where it does not.
using DepthOfRay = std::function<float(const Eigen::Vector3f& ray_c)>;

/// Plane n . p = d, camera frame.
inline DepthOfRay plane(const Eigen::Vector3f& n, float d_m) {
    return [=](const Eigen::Vector3f& ray) {
        const float depth = d_m / n.dot(ray);
        return std::isfinite(depth) && depth > 0.0f ? depth : 0.0f;
    };
}

inline DepthOfRay sphere(const Eigen::Vector3f& center_m, float radius_m) {
    return [=](const Eigen::Vector3f& ray) {
        const float a = ray.squaredNorm(), b = ray.dot(center_m);
        const float c = center_m.squaredNorm() - radius_m * radius_m;
        const float discriminant = b * b - a * c;
        return discriminant > 0.0f ? (b - std::sqrt(discriminant)) / a : 0.0f;
    };
}

/// The nearer of the two.
inline DepthOfRay both(DepthOfRay first, DepthOfRay second) {
    return [=](const Eigen::Vector3f& ray) {
        const float a = first(ray), b = second(ray);
        if (a <= 0.0f || b <= 0.0f) return std::max(a, b);
        return std::min(a, b);
    };
}

inline Intrinsics small_camera(int width_px = 96, int height_px = 80) {
    const float f = static_cast<float>(width_px);
    return {f,
            f,
            0.5f * static_cast<float>(width_px) - 0.5f,
            0.5f * static_cast<float>(height_px) - 0.5f,
            width_px,
            height_px,
            {0, 0}};
}

inline Eigen::Vector3f pixel_ray(const Intrinsics& k, int x, int y) {
    return {(static_cast<float>(x) - k.cx_px) / k.fx_px, (static_cast<float>(y) - k.cy_px) / k.fy_px, 1.0f};
}

/// width x height depths in metres, row-major.
inline std::vector<float> render_depth_m(const Intrinsics& k, const DepthOfRay& surface) {
    std::vector<float> depth_m;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) depth_m.push_back(surface(pixel_ray(k, x, y)));
    }
    return depth_m;
}

inline std::vector<std::uint16_t> to_mm(const std::vector<float>& depth_m) {
    std::vector<std::uint16_t> depth_mm;
    for (const float z : depth_m) depth_mm.push_back(static_cast<std::uint16_t>(std::lround(z * 1000.0f)));
    return depth_mm;
}

}  // namespace touchstone::test
