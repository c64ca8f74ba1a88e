#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/volume_snapshot.hpp"

namespace touchstone::test {

/// Distance to a surface, in metres, positive in free space, at a point in metres of the volume's frame.
using Distance = std::function<float(const Eigen::Vector3f& p_g_m)>;

inline std::int32_t packed_voxel(float distance_m, float max_truncation_m, int weight) {
    const float tsdf = std::clamp(distance_m / max_truncation_m, -1.0f, 1.0f);
    const auto value = static_cast<std::int32_t>(std::lround(tsdf * TSDF_SCALE));
    return (value & 0xffff) | weight << 16;
}

/// Calls f(voxel place, its index in voxels) for every voxel of the snapshot.
template <class F>
void for_each_voxel(const VolumeSnapshot& snapshot, F f) {
    const int side = snapshot.config.size_vox / BRICK_VOX;
    for (std::size_t i = 0; i < snapshot.bricks.size() * BRICK_VOXELS; ++i) {
        const int brick = snapshot.bricks[i / BRICK_VOXELS], voxel = static_cast<int>(i % BRICK_VOXELS);
        const Eigen::Vector3i corner(brick % side, brick / side % side, brick / side / side);
        f(Eigen::Vector3i(corner * BRICK_VOX + Eigen::Vector3i(voxel & 7, voxel >> 3 & 7, voxel >> 6)), i);
    }
}

/// All bricks of the cube, each voxel of this weight.
inline VolumeSnapshot snapshot_of(const VolumeConfig& config, const Distance& distance, int weight = 10) {
    VolumeSnapshot snapshot;
    snapshot.config = config;
    const VolumeParams params = make_volume_params(config);
    const int side = params.bricks_per_side;
    for (int brick = 0; brick < side * side * side; ++brick) snapshot.bricks.push_back(brick);
    snapshot.voxels.resize(snapshot.bricks.size() * BRICK_VOXELS);
    for_each_voxel(snapshot, [&](const Eigen::Vector3i& place, std::size_t i) {
        const Eigen::Vector3f p_g_m = (place.cast<float>().array() + 0.5f) * params.voxel_m;
        snapshot.voxels[i] = packed_voxel(distance(p_g_m), params.max_truncation_m, weight);
    });
    return snapshot;
}

inline Distance sphere_distance(const Eigen::Vector3f& centre_m, float radius_m) {
    return [=](const Eigen::Vector3f& p) { return (p - centre_m).norm() - radius_m; };
}

/// Around the direction z.
inline Distance torus_distance(const Eigen::Vector3f& centre_m, float ring_m, float tube_m) {
    return [=](const Eigen::Vector3f& p) {
        const Eigen::Vector3f d = p - centre_m;
        return std::hypot(std::hypot(d.x(), d.y()) - ring_m, d.z()) - tube_m;
    };
}

inline Distance box_distance(const Eigen::Vector3f& centre_m, const Eigen::Vector3f& half_m) {
    return [=](const Eigen::Vector3f& p) {
        const Eigen::Vector3f d = (p - centre_m).cwiseAbs() - half_m;
        return d.cwiseMax(0.0f).norm() + std::min(d.maxCoeff(), 0.0f);
    };
}

}  // namespace touchstone::test
