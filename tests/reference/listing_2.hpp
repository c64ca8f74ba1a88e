#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

/// Listing 2 in plain C++ over a dense volume, line for line; deviations as in PAPER.md.
namespace touchstone::reference {

struct Voxel {
    float tsdf = 0.0f;  ///< in units of max_truncation
    int weight = 0;     ///< 0 = unknown
};

struct DenseVolume {
    explicit DenseVolume(const VolumeParams& volume)
        : params(volume),
          voxels(static_cast<std::size_t>(volume.size_vox) * static_cast<std::size_t>(volume.size_vox) *
                 static_cast<std::size_t>(volume.size_vox)) {}

    Voxel& at(int x, int y, int z) {
        return voxels[static_cast<std::size_t>((z * params.size_vox + y) * params.size_vox + x)];
    }

    VolumeParams params;
    std::vector<Voxel> voxels;
};

/// Behind the surface: as deep as the noise reaches, but at least a voxel.
inline float guess_depth_m(const VolumeParams& params, const SensorNoise& noise, float depth_m) {
    const float from_offset_m = depth_m - noise.offset_m;
    return std::max(params.voxel_m,
                    3.0f * (noise.constant_m + noise.quadratic * from_offset_m * from_offset_m));
}

/// How much a sample counts: less and less behind the surface, 1 in free space.
inline int weight_along_ray(int weight, float sdf_m, float guess_m, bool is_free) {
    if (is_free) return 1;
    const float share = std::clamp(2.0f + sdf_m / guess_m, 0.0f, 1.0f);
    return std::max(1, static_cast<int>(std::lround(static_cast<float>(weight) * share)));
}

/// One sample into one voxel.
inline void update(const VolumeParams& params, Voxel& voxel, int weight, float sdf_m, float guess_m) {
    if (sdf_m <= -params.min_truncation_m) return;                       // line 10, 11
    const float tsdf = std::min(1.0f, sdf_m / params.max_truncation_m);  // lines 8, 9
    const bool is_free = sdf_m >= params.max_truncation_m;
    const bool is_guess = weight > 1 && sdf_m < -guess_m;
    if ((is_free || is_guess) && voxel.tsdf > 0.0f && voxel.tsdf < 1.0f) return;
    const int sample = weight_along_ray(weight, sdf_m, guess_m, is_free);
    const int stored = is_free && voxel.tsdf <= 0.0f ? voxel.weight * 3 / 4 : voxel.weight;
    const auto w = static_cast<float>(stored), s = static_cast<float>(sample);
    voxel.tsdf = (voxel.tsdf * w + tsdf * s) / (w + s);           // line 13
    voxel.weight = std::min(params.max_weight, stored + sample);  // lines 12, 14
}

/// depth_m, sample_weights: row-major, width_px x height_px; weight 0 is left out.
inline void integrate(DenseVolume& volume, const std::vector<float>& depth_m,
                      const std::vector<std::uint8_t>& sample_weights, const Intrinsics& k,
                      const Eigen::Isometry3f& T_g_c,
                      const SensorNoise& noise = {0.0012f, 0.0019f, 0.4f, 0.0001f}) {
    const VolumeParams& params = volume.params;
    const Eigen::Isometry3f T_c_g = T_g_c.inverse();
    for (int z = 0; z < params.size_vox; ++z) {  // lines 1, 2
        for (int y = 0; y < params.size_vox; ++y) {
            for (int x = 0; x < params.size_vox; ++x) {
                const Eigen::Vector3f cell(static_cast<float>(x), static_cast<float>(y),
                                           static_cast<float>(z));
                const Eigen::Vector3f v_g =
                    (cell + Eigen::Vector3f::Constant(0.5f)) * params.voxel_m;  // line 3
                const Eigen::Vector3f v = T_c_g * v_g;                          // line 4
                if (v.z() <= 0.05f) continue;
                const int px =
                    static_cast<int>(std::floor(v.x() / v.z() * k.fx_px + k.cx_px + 0.5f));  // line 5
                const int py = static_cast<int>(std::floor(v.y() / v.z() * k.fy_px + k.cy_px + 0.5f));
                if (px < 0 || py < 0 || px >= k.width_px || py >= k.height_px) continue;  // line 6
                const auto pixel = static_cast<std::size_t>(py * k.width_px + px);
                if (depth_m[pixel] <= 0.0f || sample_weights[pixel] == 0) continue;
                const float sdf_m = v.norm() / v.z() * (depth_m[pixel] - v.z());  // line 7
                update(params, volume.at(x, y, z), sample_weights[pixel], sdf_m,
                       guess_depth_m(params, noise, depth_m[pixel]));
            }
        }
    }
}

}  // namespace touchstone::reference
