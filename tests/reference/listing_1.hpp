#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

/// Listing 1 in plain C++, line for line. Pictures are row-major without padding; the common frame of both
/// points is the prediction's camera p instead of g, and the model's maps are those of the prediction.
namespace touchstone::reference {

struct OrientedPicture {
    int width_px = 0, height_px = 0;
    std::vector<float> depth_m;
    std::vector<Eigen::Vector3f> normals;
};

inline float sigma_inverse_depth(const AssociationParams& params, float z, float cos_theta) {
    const float cos2 = std::max(cos_theta * cos_theta, 0.01f);
    const float tan2 = (1.0f - cos2) / cos2;
    const float from_offset = z - params.noise.offset_m;
    const float sigma_z = params.noise.constant_m + params.noise.quadratic * from_offset * from_offset +
                          params.noise.grazing / std::sqrt(z) * 2.0f * tan2;
    return std::hypot(sigma_z / (z * z), params.quantisation_per_m);
}

/// Line 8: both thresholds, and what fails them.
inline RejectionCode compare_points(const AssociationParams& params, const Eigen::Vector3f& v_live,
                                    const Eigen::Vector3f& n_live, float model_m, const Eigen::Vector3f& n) {
    const bool has_normal = n.squaredNorm() > 0.5f;
    const float cos_theta = has_normal ? n.dot(v_live) / v_live.norm() : 1.0f;
    const float sigma = sigma_inverse_depth(params, v_live.z(), cos_theta);
    const float nearer = 1.0f / v_live.z() - 1.0f / model_m;
    if (nearer < -params.sigmas_high * sigma) return ASSOCIATION_BEHIND;
    if (nearer > params.sigmas_high * sigma) return ASSOCIATION_IN_FRONT;
    if (nearer > params.sigmas_low * sigma) return ASSOCIATION_SLIGHTLY_IN_FRONT;
    const bool both = has_normal && n_live.squaredNorm() > 0.5f;
    if (params.min_normal_cos > -1.0f && both && n.dot(n_live) < params.min_normal_cos)
        return ASSOCIATION_NORMAL_DIFFERS;
    return ASSOCIATION_INLIER;
}

inline std::vector<RejectionCode> associate(const OrientedPicture& live, const OrientedPicture& model,
                                            const std::vector<float>& fallback_m, const Intrinsics& k,
                                            const Eigen::Isometry3f& T_p_c, const AssociationParams& params) {
    std::vector<RejectionCode> codes(live.depth_m.size(), ASSOCIATION_NO_LIVE_DEPTH);
    for (int y = 0; y < live.height_px; ++y) {
        for (int x = 0; x < live.width_px; ++x) {  // 1
            const auto u = static_cast<std::size_t>(y * live.width_px + x);
            const float z = live.depth_m[u];
            if (z <= 0.0f) continue;  // 2
            const Eigen::Vector3f v_c(z * (static_cast<float>(x) - k.cx_px) / k.fx_px,
                                      z * (static_cast<float>(y) - k.cy_px) / k.fy_px, z);
            codes[u] = ASSOCIATION_NO_MODEL;
            const Eigen::Vector3f v = T_p_c * v_c;                                  // 3
            const float px = std::floor(k.fx_px * v.x() / v.z() + k.cx_px + 0.5f);  // 4
            const float py = std::floor(k.fy_px * v.y() / v.z() + k.cy_px + 0.5f);
            const bool inside = v.z() > 0.05f && px >= 0.0f && py >= 0.0f &&
                                px < static_cast<float>(model.width_px) &&
                                py < static_cast<float>(model.height_px);
            if (!inside) continue;
            const auto p =
                static_cast<std::size_t>(static_cast<int>(py) * model.width_px + static_cast<int>(px));
            const float model_m = model.depth_m[p] > 0.0f ? model.depth_m[p] : fallback_m[p];    // 6
            if (model_m <= 0.0f) continue;                                                       // 5
            const Eigen::Vector3f n = model.normals[p];                                          // 7
            codes[u] = compare_points(params, v, T_p_c.linear() * live.normals[u], model_m, n);  // 8, 9
        }
    }
    return codes;
}

}  // namespace touchstone::reference
