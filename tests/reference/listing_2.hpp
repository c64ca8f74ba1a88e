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
    int change = 0;     ///< average of the TSDF's change, in 1 / CHANGE_SCALE; of moving volumes
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

/// What of the stored weight still counts after the TSDF changed by `change` a frame.
inline int kept_weight(const VolumeParams& params, const AdaptiveWeightParams& adaptive, int stored,
                       float change, float sigma_m) {
    const float sigmas = std::abs(change) * params.max_truncation_m / sigma_m;
    const float calm = std::clamp(
        (adaptive.moving_sigmas - sigmas) / (adaptive.moving_sigmas - adaptive.calm_sigmas), 0.0f, 1.0f);
    const auto range = static_cast<float>(params.max_weight - adaptive.least_weight);
    return std::min(stored, adaptive.least_weight + static_cast<int>(std::lround(range * calm * calm)));
}

/// One sample into one voxel of a volume that moves with what it holds.
inline void update_moving(const VolumeParams& params, const AdaptiveWeightParams& adaptive, Voxel& voxel,
                          int weight, float sdf_m, float sigma_m) {
    const bool is_free = sdf_m >= params.max_truncation_m;
    if (sdf_m <= -params.min_truncation_m || (weight == SAMPLE_FREE_ONLY && !is_free)) return;
    const float tsdf = std::min(1.0f, sdf_m / params.max_truncation_m);
    const float difference = voxel.weight > 0 ? tsdf - voxel.tsdf : 0.0f;
    const float old_change = static_cast<float>(voxel.change) / CHANGE_SCALE;
    const float change = old_change + (difference - old_change) * adaptive.change_share;
    const int sample = weight_along_ray(weight, sdf_m, std::max(params.voxel_m, 3.0f * sigma_m), is_free);
    const int stored = kept_weight(params, adaptive, voxel.weight, change, sigma_m);
    const auto w = static_cast<float>(stored), s = static_cast<float>(sample);
    voxel.tsdf = (voxel.tsdf * w + tsdf * s) / (w + s);
    voxel.weight = std::min(params.max_weight, stored + sample);
    voxel.change = static_cast<int>(std::lround(std::clamp(change, -1.0f, 1.0f) * CHANGE_SCALE));
}

/// Depth at a place between four pixels that are within 0.015 z of each other, else the nearest pixel's.
inline float depth_between_m(const std::vector<float>& depth_m, const Intrinsics& k, float u, float v) {
    const auto at = [&](int x, int y) { return depth_m[static_cast<std::size_t>(y * k.width_px + x)]; };
    const float nearest_m =
        at(static_cast<int>(std::floor(u + 0.5f)), static_cast<int>(std::floor(v + 0.5f)));
    const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
    if (x < 0 || y < 0 || x + 1 >= k.width_px || y + 1 >= k.height_px) return nearest_m;
    const auto [low, high] = std::minmax({at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)});
    if (low <= 0.0f || high - low >= 0.015f * low) return nearest_m;
    const float a = u - static_cast<float>(x), b = v - static_cast<float>(y);
    return std::lerp(std::lerp(at(x, y), at(x + 1, y), a), std::lerp(at(x, y + 1), at(x + 1, y + 1), a), b);
}

/// Calls `update(voxel, weight, sdf_m, depth_m)` for each voxel that a pixel with a weight sees.
template <class Update>
void for_each_sample(DenseVolume& volume, const std::vector<float>& depth_m,
                     const std::vector<std::uint8_t>& sample_weights, const Intrinsics& k,
                     const Eigen::Isometry3f& T_g_c, bool between_pixels, Update update) {
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
                const float measured_m = between_pixels
                                             ? depth_between_m(depth_m, k, v.x() / v.z() * k.fx_px + k.cx_px,
                                                               v.y() / v.z() * k.fy_px + k.cy_px)
                                             : depth_m[pixel];
                const float sdf_m = v.norm() / v.z() * (measured_m - v.z());  // line 7
                update(volume.at(x, y, z), sample_weights[pixel], sdf_m, measured_m);
            }
        }
    }
}

/// depth_m, sample_weights: row-major, width_px x height_px; weight 0 is left out.
inline void integrate(DenseVolume& volume, const std::vector<float>& depth_m,
                      const std::vector<std::uint8_t>& sample_weights, const Intrinsics& k,
                      const Eigen::Isometry3f& T_g_c,
                      const SensorNoise& noise = {0.0012f, 0.0019f, 0.4f, 0.0001f}) {
    for_each_sample(volume, depth_m, sample_weights, k, T_g_c, false,
                    [&](Voxel& voxel, int weight, float sdf_m, float z_m) {
                        update(volume.params, voxel, weight, sdf_m, guess_depth_m(volume.params, noise, z_m));
                    });
}

/// The adaptive variant; weights as in VolumetricIntegration::integrate_moving.
inline void integrate_moving(DenseVolume& volume, const AdaptiveWeightParams& adaptive,
                             const std::vector<float>& depth_m,
                             const std::vector<std::uint8_t>& sample_weights, const Intrinsics& k,
                             const Eigen::Isometry3f& T_g_c,
                             const SensorNoise& noise = {0.0012f, 0.0019f, 0.4f, 0.0001f}) {
    for_each_sample(volume, depth_m, sample_weights, k, T_g_c, true,
                    [&](Voxel& voxel, int weight, float sdf_m, float z_m) {
                        const float from_offset_m = z_m - noise.offset_m;
                        const float sigma_m =
                            noise.constant_m + noise.quadratic * from_offset_m * from_offset_m;
                        update_moving(volume.params, adaptive, voxel, weight, sdf_m, sigma_m);
                    });
}

}  // namespace touchstone::reference
