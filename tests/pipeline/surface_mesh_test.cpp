#include "pipeline/surface_mesh.hpp"

#include <gtest/gtest.h>
#include <random>
#include <set>

#include "pipeline/brick_neighbourhood.hpp"
#include "tests/support/distance_snapshot.hpp"
#include "tests/support/mesh_topology.hpp"
#include "tests/support/small_volume.hpp"

namespace touchstone {
namespace {

using test::small_volume;
using test::snapshot_of;
using test::topology_of;

constexpr float voxel_m = 0.01f;  // of small_volume
const Eigen::Vector3f centre_m(0.313f, 0.328f, 0.322f);

/// Largest distance of a vertex from the surface, in voxels.
float worst_vertex_vox(const SurfaceMesh& mesh, const test::Distance& distance) {
    float worst = 0.0f;
    for (const auto& vertex : mesh.vertices_g_m) worst = std::max(worst, std::abs(distance(vertex)));
    return worst / voxel_m;
}

/// Least cosine between the vertices' normals and the distance's gradient, and between these and the
/// triangles'.
std::pair<float, float> least_normal_cos(const SurfaceMesh& mesh, const test::Distance& distance) {
    std::vector<Eigen::Vector3f> truth;
    float least_vertex = 1.0f, least_face = 1.0f;
    for (std::size_t i = 0; i < mesh.vertices_g_m.size(); ++i) {
        Eigen::Vector3f gradient;
        for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3f step = 0.001f * Eigen::Vector3f::Unit(axis);
            gradient[axis] = distance(mesh.vertices_g_m[i] + step) - distance(mesh.vertices_g_m[i] - step);
        }
        truth.push_back(gradient.normalized());
        EXPECT_NEAR(mesh.normals_g[i].norm(), 1.0f, 1e-5f);
        least_vertex = std::min(least_vertex, truth.back().dot(mesh.normals_g[i]));
    }
    for (const auto& triangle : mesh.triangles) {
        least_face = std::min(least_face, truth[triangle[0]].dot(test::face_normal(mesh, triangle)));
    }
    return {least_vertex, least_face};
}

void expect_closed(const SurfaceMesh& mesh) {
    const test::Topology topology = topology_of(mesh);
    EXPECT_EQ(topology.open_edges, 0);
    EXPECT_EQ(topology.pinched_vertices, 0);
    // Sides are at least 0.01 / 6 of a voxel, 1.6e-5 m: 6 voxels are the most a voxel is off the surface.
    // Floats below 1 m are good to 6e-8 m.
    EXPECT_GT(topology.least_area_m2, 5e-11f);
}

TEST(SurfaceMesh, SphereIsClosedRoundAndTurnedOutwards) {
    const auto sphere = test::sphere_distance(centre_m, 0.2f);
    const SurfaceMesh mesh = extract_surface(snapshot_of(small_volume(), sphere));
    expect_closed(mesh);
    EXPECT_EQ(topology_of(mesh).euler, 2);
    EXPECT_NEAR(topology_of(mesh).volume_m3, 4.0 / 3.0 * 3.14159265 * 0.008, 1e-4);
    // The chord of a voxel is 0.6 % of a voxel inside a sphere of 20 voxels; vertices stay 1 % from voxels.
    EXPECT_LT(worst_vertex_vox(mesh, sphere), 0.015f);
    const auto [vertex_cos, face_cos] = least_normal_cos(mesh, sphere);
    EXPECT_GT(vertex_cos, 0.9995f);
    EXPECT_GT(face_cos, 0.95f);
    EXPECT_TRUE(mesh.colors.empty());
}

TEST(SurfaceMesh, TorusHasOneHole) {
    const auto torus = test::torus_distance(centre_m, 0.18f, 0.07f);
    const SurfaceMesh mesh = extract_surface(snapshot_of(small_volume(), torus));
    expect_closed(mesh);
    EXPECT_EQ(topology_of(mesh).euler, 0);
    EXPECT_LT(worst_vertex_vox(mesh, torus), 0.03f);  // of seven voxels: chords are up to 1.8 % inside
    const auto [vertex_cos, face_cos] = least_normal_cos(mesh, torus);
    EXPECT_GT(vertex_cos, 0.99f);
    EXPECT_GT(face_cos, 0.9f);
}

TEST(SurfaceMesh, BoxKeepsItsFaces) {
    const auto box = test::box_distance(centre_m, {0.15f, 0.11f, 0.2f});
    const SurfaceMesh mesh = extract_surface(snapshot_of(small_volume(), box));
    expect_closed(mesh);
    EXPECT_EQ(topology_of(mesh).euler, 2);
    EXPECT_LT(worst_vertex_vox(mesh, box), 0.5f);  // at its edges; elsewhere exact
    std::size_t off_faces = 0;
    for (const auto& vertex : mesh.vertices_g_m) off_faces += std::abs(box(vertex)) > 0.015f * voxel_m;
    EXPECT_LT(off_faces, mesh.vertices_g_m.size() / 15) << "its edges alone are rounded";
}

TEST(SurfaceMesh, PlaneOverBrickBordersHasNoCracks) {
    const Eigen::Vector3f normal = Eigen::Vector3f(0.31f, -0.52f, 0.8f).normalized();
    const auto plane = [&](const Eigen::Vector3f& p) { return normal.dot(p - centre_m); };
    const SurfaceMesh mesh = extract_surface(snapshot_of(small_volume(), plane));
    EXPECT_LT(worst_vertex_vox(mesh, plane), 0.015f);
    for (const auto& triangle : mesh.triangles)
        ASSERT_GT(test::face_normal(mesh, triangle).dot(normal), 0.9f);
    for (const auto& n : mesh.normals_g) ASSERT_GT(n.dot(normal), 0.999f);
    const test::Topology topology = topology_of(mesh);
    EXPECT_EQ(topology.euler, 1) << "one sheet: a crack would be a hole in it";
    EXPECT_GT(topology.open_edges, 0) << "it ends at the cube's sides";
    const auto on_side = [](float x) { return x < 0.5001f * voxel_m || x > 63.4999f * voxel_m; };
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
    }
    for (const auto& [side, count] : sides) {
        if (count == 2) continue;
        ASSERT_EQ(count, 1);
        const Eigen::Vector3f &a = mesh.vertices_g_m[side.first], &b = mesh.vertices_g_m[side.second];
        bool both_on_a_side = false;
        for (int axis = 0; axis < 3; ++axis) both_on_a_side |= on_side(a[axis]) && on_side(b[axis]);
        ASSERT_TRUE(both_on_a_side);
    }
}

/// 24^3 voxels, free around; inside the shell what `value` gives.
template <class F>
VolumeSnapshot noise_volume(F value) {
    VolumeConfig config;
    config.size_vox = 24;
    config.side_m = 0.24f;
    VolumeSnapshot snapshot = snapshot_of(config, [](const Eigen::Vector3f&) { return 1.0f; });
    test::for_each_voxel(snapshot, [&](const Eigen::Vector3i& place, std::size_t i) {
        if (place.minCoeff() == 0 || place.maxCoeff() == 23) return;
        snapshot.voxels[i] = (value() & 0xffff) | 10 << 16;
    });
    return snapshot;
}

std::set<int> cases_in(const VolumeSnapshot& snapshot) {
    std::vector<bool> inside(24 * 24 * 24);
    test::for_each_voxel(snapshot, [&](const Eigen::Vector3i& place, std::size_t i) {
        inside[static_cast<std::size_t>((place.z() * 24 + place.y()) * 24 + place.x())] =
            voxel_tsdf(snapshot.voxels[i]) <= 0;
    });
    std::set<int> cases;
    for (int i = 0; i < 23 * 23 * 23; ++i) {
        int found = 0;
        for (int c = 0; c < 8; ++c) {
            const int x = i % 23 + (c & 1), y = i / 23 % 23 + (c >> 1 & 1), z = i / 529 + (c >> 2);
            found |= static_cast<int>(inside[static_cast<std::size_t>((z * 24 + y) * 24 + x)]) << c;
        }
        cases.insert(found);
    }
    return cases;
}

TEST(SurfaceMesh, AllCellConfigurationsTogetherAreWatertight) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> any(-32766, 32766);
    const VolumeSnapshot snapshot = noise_volume([&] { return any(random); });
    EXPECT_EQ(cases_in(snapshot).size(), 256u);
    const SurfaceMesh mesh = extract_surface(snapshot, {1, 0});
    expect_closed(mesh);
    EXPECT_GT(topology_of(mesh).volume_m3, 0.0);
}

TEST(SurfaceMesh, VoxelsExactlyOnTheSurfaceAreInsideAndOpenNoHoles) {
    std::mt19937 random(8);
    std::uniform_int_distribution<int> few(-1, 1);
    expect_closed(extract_surface(noise_volume([&] { return 20000 * few(random); }), {1, 0}));
    const SurfaceMesh zeros = extract_surface(noise_volume([] { return 0; }), {1, 0});
    expect_closed(zeros);
    EXPECT_EQ(topology_of(zeros).euler, 2);
}

TEST(SurfaceMesh, UnknownVoxelsGiveNoSurface) {
    const auto sphere = test::sphere_distance(centre_m, 0.2f);
    VolumeSnapshot snapshot = snapshot_of(small_volume(), sphere, 2);
    EXPECT_TRUE(extract_surface(snapshot).triangles.empty()) << "all seen less than three times";
    EXPECT_FALSE(extract_surface(snapshot, {2, 0}).triangles.empty());
    // Too little is known at z > 0.3 m, voxels 30 and up, and it is wrong.
    test::for_each_voxel(snapshot, [&](const Eigen::Vector3i& place, std::size_t i) {
        if (place.z() >= 30) snapshot.voxels[i] = (place.x() % 2 == 0 ? 30000 : -30000 & 0xffff) | 1 << 16;
    });
    const SurfaceMesh half = extract_surface(snapshot, {2, 0});
    EXPECT_EQ(topology_of(half).euler, 1) << "a cap";
    for (const auto& vertex : half.vertices_g_m) ASSERT_LE(vertex.z(), 29.5001f * voxel_m);
    EXPECT_LT(worst_vertex_vox(half, sphere), 0.015f);
    EXPECT_GT(least_normal_cos(half, sphere).first, 0.99f) << "one-sided differences at the rim";
}

TEST(SurfaceMesh, EndsAtTheCubesSides) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side_m : {0.0f, 0.64f}) {
            Eigen::Vector3f middle = centre_m;
            middle[axis] = side_m;
            const auto sphere = test::sphere_distance(middle, 0.2f);
            const SurfaceMesh mesh = extract_surface(snapshot_of(small_volume(), sphere), {1, 0});
            EXPECT_EQ(topology_of(mesh).euler, 1) << "a cap";
            EXPECT_LT(worst_vertex_vox(mesh, sphere), 0.015f);
        }
    }
}

TEST(SurfaceMesh, ThinThingsAreNotTornAtTheirDiagonals) {
    // One voxel after the other, connected by their corners within a layer only.
    VolumeSnapshot snapshot = noise_volume([] { return 20000; });
    test::for_each_voxel(snapshot, [&](const Eigen::Vector3i& place, std::size_t i) {
        if (place.x() == place.y() && place.z() == 12 && place.x() > 3 && place.x() < 20)
            snapshot.voxels[i] = (-20000 & 0xffff) | 10 << 16;
    });
    const SurfaceMesh mesh = extract_surface(snapshot, {1, 0});
    expect_closed(mesh);
    EXPECT_EQ(topology_of(mesh).euler, 2) << "one piece";
}

TEST(SurfaceMesh, AbsentBricksAreUnknown) {
    const auto sphere = test::sphere_distance(centre_m, 0.2f);
    const VolumeSnapshot whole = snapshot_of(small_volume(), sphere);
    VolumeSnapshot sparse;
    sparse.config = whole.config;
    for (std::size_t slot = 0; slot < whole.bricks.size(); ++slot) {
        const auto first = whole.voxels.begin() + static_cast<std::ptrdiff_t>(slot * BRICK_VOXELS);
        const bool near_surface = std::any_of(first, first + BRICK_VOXELS, [](std::int32_t voxel) {
            return std::abs(voxel_tsdf(voxel)) < 32766;
        });
        if (!near_surface) continue;
        sparse.bricks.push_back(whole.bricks[slot]);
        sparse.voxels.insert(sparse.voxels.end(), first, first + BRICK_VOXELS);
    }
    ASSERT_LT(sparse.bricks.size(), whole.bricks.size());
    const SurfaceMesh mesh = extract_surface(sparse), expected = extract_surface(whole);
    EXPECT_EQ(mesh.vertices_g_m, expected.vertices_g_m);
    EXPECT_EQ(mesh.triangles, expected.triangles);
    EXPECT_TRUE(extract_surface(VolumeSnapshot{}).triangles.empty());
}

TEST(SurfaceMesh, SmallPiecesAreLeftOut) {
    const auto big = test::sphere_distance({0.2f, 0.2f, 0.2f}, 0.12f);
    const auto small = test::sphere_distance({0.5f, 0.5f, 0.5f}, 0.012f);
    const auto both = [&](const Eigen::Vector3f& p) { return std::min(big(p), small(p)); };
    const VolumeSnapshot snapshot = snapshot_of(small_volume(), both);
    const SurfaceMesh all = extract_surface(snapshot, {3, 0}), cleaned = extract_surface(snapshot, {3, 100});
    EXPECT_EQ(topology_of(all).euler, 4);
    EXPECT_EQ(topology_of(cleaned).euler, 2);
    expect_closed(cleaned);
    EXPECT_LT(worst_vertex_vox(cleaned, big), 0.05f);
    EXPECT_EQ(cleaned.normals_g.size(), cleaned.vertices_g_m.size());
    EXPECT_EQ(extract_surface(snapshot, {3, 1}).triangles, all.triangles);
    const int small_triangles = static_cast<int>(all.triangles.size() - cleaned.triangles.size());
    EXPECT_EQ(extract_surface(snapshot, {3, small_triangles}).triangles.size(), all.triangles.size());
    EXPECT_EQ(extract_surface(snapshot, {3, small_triangles + 1}).triangles.size(), cleaned.triangles.size());
}

/// Red grows with x; the brick at the cube's corner 0 0 0 has none, nor have voxels of z < 0.2 m.
VolumeSnapshot coloured(VolumeSnapshot snapshot) {
    snapshot.color_bricks.assign(snapshot.bricks.begin() + 1, snapshot.bricks.end());
    snapshot.colors.resize(snapshot.color_bricks.size() * BRICK_VOXELS);
    test::for_each_voxel(snapshot, [&](const Eigen::Vector3i& place, std::size_t i) {
        if (i < BRICK_VOXELS || place.z() < 20) return;
        snapshot.colors[i - BRICK_VOXELS] =
            static_cast<std::uint32_t>(place.x() * 3) | 77U << 8 | 200U << 16 | 5U << 24;
    });
    return snapshot;
}

TEST(SurfaceMesh, ColoursComeFromTheVoxels) {
    const auto sphere = test::sphere_distance(centre_m, 0.2f);
    const SurfaceMesh mesh = extract_surface(coloured(snapshot_of(small_volume(), sphere)));
    ASSERT_EQ(mesh.colors.size(), mesh.vertices_g_m.size());
    int grey = 0;
    for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
        const Eigen::Vector3f place_vox = mesh.vertices_g_m[i] / voxel_m;
        if (place_vox.z() < 19.4f) {
            ++grey;
            ASSERT_EQ(mesh.colors[i], (std::array<std::uint8_t, 3>{128, 128, 128}));
        } else if (place_vox.z() > 20.6f) {
            ASSERT_NEAR(mesh.colors[i][0], (place_vox.x() - 0.5f) * 3.0f, 0.6f);
            ASSERT_EQ(mesh.colors[i][1], 77);
            ASSERT_EQ(mesh.colors[i][2], 200);
        } else {
            ASSERT_TRUE(mesh.colors[i][1] == 77 || mesh.colors[i][1] == 128)
                << "no mean with unknown colours";
        }
    }
    EXPECT_GT(grey, 100);
}

TEST(SurfaceMesh, EqualSnapshotsGiveEqualMeshes) {
    const auto snapshot = coloured(snapshot_of(small_volume(), test::torus_distance(centre_m, 0.18f, 0.07f)));
    const SurfaceMesh a = extract_surface(snapshot), b = extract_surface(snapshot);
    EXPECT_EQ(a.vertices_g_m, b.vertices_g_m);
    EXPECT_EQ(a.normals_g, b.normals_g);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.triangles, b.triangles);
}

}  // namespace
}  // namespace touchstone
