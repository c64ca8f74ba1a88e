#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "pipeline/types.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/distance_snapshot.hpp"
#include "tests/support/global_scene.hpp"
#include "tests/support/small_volume.hpp"

/// A floor, a wall behind it and a box on the floor, each of its own colour, known everywhere in a cube of
/// 64^3 voxels of 10 mm. Global frame: y down. The box's faces lie between voxel centres as they come.
namespace touchstone::test {

inline constexpr float floor_y_m = 0.503f, wall_z_m = 0.584f;
inline const Eigen::Vector3f box_low_m{0.262f, 0.353f, 0.283f}, box_high_m{0.394f, 0.503f, 0.404f};
inline const std::array<Eigen::Vector3f, 3> colors_of_parts{
    Eigen::Vector3f(51, 178, 76), Eigen::Vector3f(204, 51, 51), Eigen::Vector3f(51, 76, 204)};  // 0..255

inline Eigen::Vector3f distances_m(const Eigen::Vector3f& p) {
    const Eigen::Vector3f centre = 0.5f * (box_low_m + box_high_m), half = 0.5f * (box_high_m - box_low_m);
    return {floor_y_m - p.y(), wall_z_m - p.z(), box_distance(centre, half)(p)};
}

inline VolumeSnapshot lit_scene_snapshot() {
    VolumeSnapshot snapshot =
        snapshot_of(small_volume(), [](const Eigen::Vector3f& p) { return distances_m(p).minCoeff(); });
    snapshot.color_bricks = snapshot.bricks;
    snapshot.colors.resize(snapshot.voxels.size());
    const float voxel_m = make_volume_params(snapshot.config).voxel_m;
    for_each_voxel(snapshot, [&](const Eigen::Vector3i& place, std::size_t i) {
        std::size_t part = 0;
        (void)distances_m((place.cast<float>().array() + 0.5f) * voxel_m).minCoeff(&part);
        const Eigen::Matrix<std::uint32_t, 3, 1> rgb = colors_of_parts[part].cast<std::uint32_t>();
        snapshot.colors[i] = rgb.x() | rgb.y() << 8 | rgb.z() << 16 | 10u << 24;
    });
    return snapshot;
}

/// The same without the bricks that are farther than the truncation from every surface, as scans are.
inline VolumeSnapshot without_free_bricks(const VolumeSnapshot& all) {
    VolumeSnapshot sparse;
    sparse.config = all.config;
    for (std::size_t i = 0; i < all.bricks.size(); ++i) {
        const auto voxels = std::span(all.voxels).subspan(i * BRICK_VOXELS, BRICK_VOXELS);
        const auto colors = std::span(all.colors).subspan(i * BRICK_VOXELS, BRICK_VOXELS);
        if (std::ranges::all_of(voxels, [](int v) { return (v & 0xffff) == static_cast<int>(TSDF_SCALE); }))
            continue;
        sparse.bricks.push_back(all.bricks[i]);
        sparse.color_bricks.push_back(all.bricks[i]);
        sparse.voxels.insert(sparse.voxels.end(), voxels.begin(), voxels.end());
        sparse.colors.insert(sparse.colors.end(), colors.begin(), colors.end());
    }
    return sparse;
}

/// Camera at `from` that looks at `to`, its x axis level.
inline RigidTransform looking_at(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    const Eigen::Vector3f z = (to - from).normalized();
    const Eigen::Vector3f x = Eigen::Vector3f::UnitY().cross(z).normalized();
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.linear() << x, z.cross(x), z;
    T_g_c.translation() = from;
    return T_g_c;
}

/// Where a ray meets the scene, in units of its direction's length.
struct SceneHit {
    float t;
    Eigen::Vector3f point, normal, color;  ///< colour 0..1
    float to_edge_m;  ///< distance to the nearest other surface or the end of this one, at most so far
};

/// The nearest surface inside the cube; nothing where the ray leaves it first.
inline std::optional<SceneHit> hit_scene(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
    const auto plane_at = [](float distance_m, float slope) {
        return slope > 0.0f ? std::max(0.0f, distance_m / slope) : 0.0f;
    };
    const Surface floor = [&](const auto& o, const auto& d) { return plane_at(floor_y_m - o.y(), d.y()); };
    const Surface wall = [&](const auto& o, const auto& d) { return plane_at(wall_z_m - o.z(), d.z()); };
    const float t = nearest({floor, wall, box(box_low_m, box_high_m)})(origin, direction);
    const Eigen::Vector3f p = origin + t * direction;
    if (t <= 0.0f || p.minCoeff() < 0.0f || p.maxCoeff() > 0.64f) return std::nullopt;
    std::size_t part = 0;
    const Eigen::Vector3f distances = distances_m(p);
    (void)distances.cwiseAbs().minCoeff(&part);
    SceneHit hit{t, p, -Eigen::Vector3f::UnitY(), colors_of_parts[part] / 255.0f, 0.0f};
    if (part == 1) hit.normal = -Eigen::Vector3f::UnitZ();
    Eigen::Vector3f to_faces = (p - box_low_m).cwiseAbs().cwiseMin((p - box_high_m).cwiseAbs());
    if (part == 2) {
        int axis = 0;
        (void)to_faces.minCoeff(&axis);
        hit.normal = Eigen::Vector3f::Zero();
        hit.normal[axis] = p[axis] > 0.5f * (box_low_m + box_high_m)[axis] ? 1.0f : -1.0f;
        to_faces[axis] = 1.0f;
        hit.to_edge_m = to_faces.minCoeff();
    } else {
        Eigen::Vector3f others = distances;
        others[static_cast<int>(part)] = 1.0f;
        hit.to_edge_m = others.minCoeff();
    }
    hit.to_edge_m = std::min({hit.to_edge_m, p.minCoeff(), 0.64f - p.maxCoeff()});
    return hit;
}

/// Whether the box, grown by `by_m` on all sides, is between two points.
inline bool box_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float by_m) {
    const Eigen::Vector3f by = Eigen::Vector3f::Constant(by_m);
    const float t = box(box_low_m - by, box_high_m + by)(from, to - from);
    return t > 0.0f && t < 1.0f;
}

}  // namespace touchstone::test
