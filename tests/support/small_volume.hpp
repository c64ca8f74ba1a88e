#pragma once

#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"

namespace touchstone::test {

/// 64^3 voxels of 10 mm; `max_weight` low where a test shall reach it.
inline VolumeConfig small_volume(int max_weight = 128) {
    VolumeConfig config;
    config.size_vox = 64;
    config.side_m = 0.64f;
    config.max_weight = max_weight;
    return config;
}

/// A camera 35 cm in front of that cube, turned a little about no axis in particular.
inline RigidTransform pose_in_front() {
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.translate(Eigen::Vector3f(0.33f, 0.30f, -0.35f));
    T_g_c.rotate(Eigen::AngleAxisf(0.1f, Eigen::Vector3f(0.3f, 1.0f, 0.2f).normalized()));
    return T_g_c;
}

}  // namespace touchstone::test
