#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

/// Fig 11a in plain C++, pixel by pixel. Pictures are row-major without padding.
namespace touchstone::reference {

struct Picture {
    int width_px = 0, height_px = 0;
    std::vector<float> depth_m;

    float at(int x, int y) const {
        if (x < 0 || y < 0 || x >= width_px || y >= height_px) return 0.0f;
        return depth_m[static_cast<std::size_t>(y * width_px + x)];
    }
};

inline Picture convert_depth(const std::vector<std::uint16_t>& depth_mm, int width_px, int height_px,
                             const FilterParams& params) {
    Picture picture{width_px, height_px, {}};
    for (const std::uint16_t mm : depth_mm) {
        const float z = static_cast<float>(mm) * 0.001f;
        picture.depth_m.push_back(z >= params.min_depth_m && z <= params.max_depth_m ? z : 0.0f);
    }
    return picture;
}

inline float sigma_z_m(const SensorNoise& noise, float z) {
    return noise.constant_m + noise.quadratic * (z - noise.offset_m) * (z - noise.offset_m);
}

inline float compact_gauss(float e) { return std::pow(std::max(1.0f - e / 8.0f, 0.0f), 8.0f); }

inline Picture bilateral_filter(const Picture& in, const FilterParams& params) {
    Picture out = in;
    for (int y = 0; y < in.height_px; ++y) {
        for (int x = 0; x < in.width_px; ++x) {
            const float center = in.at(x, y);
            if (center <= 0.0f) continue;
            const float sigma =
                std::min(params.range_sigmas * sigma_z_m(params.noise, center), 0.25f * center);
            float sum = 0.0f, weights = 0.0f;
            for (int j = -2; j <= 2; ++j) {
                for (int i = -2; i <= 2; ++i) {
                    const float d = in.at(x + i, y + j);
                    if (d <= 0.0f) continue;
                    const float spatial = static_cast<float>(i * i + j * j) /
                                          (2.0f * params.spatial_sigma_px * params.spatial_sigma_px);
                    const float w =
                        compact_gauss(spatial + (d - center) * (d - center) / (2.0f * sigma * sigma));
                    sum += w * d;
                    weights += w;
                }
            }
            out.depth_m[static_cast<std::size_t>(y * in.width_px + x)] = sum / weights;
        }
    }
    return out;
}

inline Eigen::Vector3f vertex(const Picture& in, const Intrinsics& k, int x, int y) {
    return in.at(x, y) * Eigen::Vector3f((static_cast<float>(x) - k.cx_px) / k.fx_px,
                                         (static_cast<float>(y) - k.cy_px) / k.fy_px, 1.0f);
}

/// Zero where there is no normal.
inline Eigen::Vector3f normal(const Picture& in, const Intrinsics& k, int x, int y, float gap_per_m) {
    const float z = in.at(x, y);
    if (z <= 0.0f) return Eigen::Vector3f::Zero();
    const auto joined = [&](int i, int j) {
        return in.at(i, j) > 0.0f && std::abs(in.at(i, j) - z) < gap_per_m * z;
    };
    if (!joined(x - 1, y) && !joined(x + 1, y)) return Eigen::Vector3f::Zero();
    if (!joined(x, y - 1) && !joined(x, y + 1)) return Eigen::Vector3f::Zero();
    const auto point = [&](int i, int j) { return joined(i, j) ? vertex(in, k, i, j) : vertex(in, k, x, y); };
    const Eigen::Vector3f n =
        (point(x + 1, y) - point(x - 1, y)).cross(point(x, y + 1) - point(x, y - 1)).normalized();
    return n.dot(vertex(in, k, x, y)) > 0.0f ? Eigen::Vector3f(-n) : n;
}

}  // namespace touchstone::reference
