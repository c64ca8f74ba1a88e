#pragma once

#include "tests/reference/depth_map_conversion.hpp"

/// The weight of a sample in plain C++, pixel by pixel.
namespace touchstone::reference {

inline bool is_between(float before, float here, float after, float gap_m) {
    if (before <= 0.0f || after <= 0.0f) return false;
    return std::min(before, after) < here - gap_m && std::max(before, after) > here + gap_m;
}

/// The pixel's normal is the zero vector where it has none.
inline int sample_weight(const Picture& depth, const Intrinsics& k, const Eigen::Vector3f& normal, int x,
                         int y, const SampleWeightParams& params) {
    const float z = depth.at(x, y);
    if (z <= 0.0f) return 0;
    const float gap_m = params.gap_per_m * z;
    if (is_between(depth.at(x - 1, y), z, depth.at(x + 1, y), gap_m)) return 0;
    if (is_between(depth.at(x, y - 1), z, depth.at(x, y + 1), gap_m)) return 0;
    if (normal.isZero()) return 1;
    const float cos_theta = -normal.dot(vertex(depth, k, x, y).normalized());
    if (cos_theta < params.min_cos) return 0;
    const float tan2 = 1.0f / (cos_theta * cos_theta) - 1.0f;
    const float sigma_m = sigma_z_m(params.noise, z) + params.noise.grazing / std::sqrt(z) * 2.0f * tan2;
    const float weight = static_cast<float>(params.most) * std::pow(params.reference_sigma_m / sigma_m, 2.0f);
    return static_cast<int>(std::lround(std::clamp(weight, 1.0f, static_cast<float>(params.most))));
}

}  // namespace touchstone::reference
