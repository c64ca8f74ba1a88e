#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "tests/reference/listing_2.hpp"

/// Listing 3 (surface prediction) in plain C++: a quarter-voxel walk, trilinear samples, linear
/// interpolation.
namespace touchstone::reference {

/// Trilinear TSDF at a point of the global frame; nothing where one of the eight voxels is unknown.
inline std::optional<float> sample(DenseVolume& volume, const Eigen::Vector3f& p_g) {
    const Eigen::Vector3f p = p_g / volume.params.voxel_m - Eigen::Vector3f::Constant(0.5f);
    const Eigen::Vector3i cell = p.array().floor().cast<int>();
    if (cell.minCoeff() < 0 || cell.maxCoeff() + 1 >= volume.params.size_vox) return std::nullopt;
    const Eigen::Vector3f a = p - cell.cast<float>();
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
        const Voxel& voxel = volume.at(cell.x() + dx, cell.y() + dy, cell.z() + dz);
        if (voxel.weight == 0) return std::nullopt;
        sum += voxel.tsdf * (dx ? a.x() : 1.0f - a.x()) * (dy ? a.y() : 1.0f - a.y()) *
               (dz ? a.z() : 1.0f - a.z());
    }
    return sum;
}

/// Depth z of the first change from positive to negative along the ray K^-1 [u, 1]; 0 where there is none
/// before end_m.
inline float raycast(DenseVolume& volume, const Eigen::Isometry3f& T_g_c, const Eigen::Vector3f& ray_c,
                     float end_m) {
    const float step_m = 0.25f * volume.params.voxel_m / ray_c.norm();
    std::optional<float> before;
    for (float t = 0.1f; t < end_m; t += step_m) {
        const std::optional<float> here = sample(volume, T_g_c * (t * ray_c));
        if (before && here && *before > 0.0f && *here <= 0.0f) return t - step_m * *here / (*here - *before);
        if (before && here && *before < 0.0f && *here > 0.0f) return 0.0f;
        before = here;
    }
    return 0.0f;
}

}  // namespace touchstone::reference
