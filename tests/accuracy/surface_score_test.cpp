#include "tests/accuracy/surface_score.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/mesh_file.hpp"
#include "tests/accuracy/mesh_input.hpp"
#include "tests/support/distance_snapshot.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/mesh_topology.hpp"
#include "tests/support/small_volume.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

const Eigen::Vector3f middle_m(0.32f, 0.32f, 0.32f);

SurfaceMesh mesh_of(const test::Distance& distance) {
    return extract_surface(test::snapshot_of(test::small_volume(), distance), {1, 0});
}

SurfaceMesh sphere(float radius_m) { return mesh_of(test::sphere_distance(middle_m, radius_m)); }

/// A body without symmetry: a box with a ball on one corner.
SurfaceMesh odd_body() {
    const auto box = test::box_distance(middle_m, {0.16f, 0.11f, 0.07f});
    const auto ball = test::sphere_distance(middle_m + Eigen::Vector3f(0.14f, 0.06f, 0.09f), 0.06f);
    return mesh_of([=](const Eigen::Vector3f& p) { return std::min(box(p), ball(p)); });
}

Eigen::Isometry3f motion(float angle_rad, const Eigen::Vector3f& shift_m) {
    Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
    T.translate(middle_m + shift_m);
    T.rotate(Eigen::AngleAxisf(angle_rad, Eigen::Vector3f(0.3f, -0.8f, 0.5f).normalized()));
    T.translate(-middle_m);
    return T;
}

TEST(SurfaceScore, SamplesAreEvenByArea) {
    SurfaceMesh mesh;  // a unit square of two triangles, one of them in four parts, and one without area
    mesh.vertices_g_m = {{0, 0, 0},    {1, 0, 0},    {1, 1, 0},      {0, 1, 0},
                         {0.5f, 1, 0}, {0, 0.5f, 0}, {0.5f, 0.5f, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 0, 1}, {0, 6, 5}, {5, 6, 4}, {5, 4, 3}, {6, 2, 4}};
    const auto points = sample_surface(mesh, 40'000);
    ASSERT_EQ(points.size(), 40'000u);
    std::array<int, 16> cells{};
    for (const auto& p : points) {
        ASSERT_EQ(p.z(), 0.0f);
        const int x = std::min(static_cast<int>(4.0f * p.x()), 3),
                  y = std::min(static_cast<int>(4.0f * p.y()), 3);
        ++cells.at(static_cast<std::size_t>(4 * y + x));
    }
    for (const int count : cells) EXPECT_NEAR(count, 2500, 100);
}

TEST(SurfaceScore, SpheresAKnownDistanceApart) {
    const SurfaceScore score = score_surface(sphere(0.204f), sphere(0.2f), 20'000);
    // Chords of 10 mm are at most 0.06 mm inside these spheres.
    EXPECT_NEAR(score.mean_mm, 4.0, 0.07);
    EXPECT_NEAR(score.rms_mm, 4.0, 0.07);
    EXPECT_NEAR(score.median_mm, 4.0, 0.07);
    EXPECT_NEAR(score.percentile_95_mm, 4.0, 0.12);
    EXPECT_EQ(score.share_over_5_mm, 0.0);
    EXPECT_EQ(score.completeness_5_mm, 1.0);
    const SurfaceScore far = score_surface(sphere(0.207f), sphere(0.2f), 20'000);
    EXPECT_EQ(far.share_over_5_mm, 1.0);
    EXPECT_EQ(far.share_over_10_mm, 0.0);
    EXPECT_EQ(far.completeness_5_mm, 0.0);
    EXPECT_EQ(far.completeness_10_mm, 1.0);
}

TEST(SurfaceScore, AShiftedSphereIsOffByTheShareOfItsShift) {
    const SurfaceMesh mesh = sphere(0.2f);
    const Eigen::Isometry3f shift(Eigen::Translation3f(0.012f, 0.0f, 0.0f));
    const SurfaceScore score = score_surface(transformed(mesh, shift), mesh, 20'000);
    // |cos| is even over a sphere: distances are even from 0 to 12 mm, a little more or less by the shift's
    // square.
    EXPECT_NEAR(score.mean_mm, 6.0, 0.1);
    EXPECT_NEAR(score.percentile_95_mm, 11.4, 0.15);
    EXPECT_NEAR(score.share_over_5_mm, 7.0 / 12.0, 0.02);
    EXPECT_NEAR(score.share_over_10_mm, 2.0 / 12.0, 0.02);
    EXPECT_NEAR(score.completeness_5_mm, 5.0 / 12.0, 0.02);
}

TEST(SurfaceScore, AHalfIsAccurateAndHalfComplete) {
    const SurfaceMesh whole = sphere(0.2f);
    SurfaceMesh half = whole;
    std::erase_if(half.triangles, [&](const auto& t) { return half.vertices_g_m[t[0]].x() > middle_m.x(); });
    const SurfaceScore score = score_surface(half, whole, 20'000);
    EXPECT_LT(score.mean_mm, 0.001);
    EXPECT_NEAR(score.completeness_5_mm, 0.5 + 0.5 * 5.0 / 200.0, 0.02);
}

TEST(SurfaceScore, AlignmentFindsTheMotion) {
    const SurfaceMesh truth = odd_body();
    const Eigen::Isometry3f T_truth_mesh = motion(0.25f, {0.03f, -0.025f, 0.02f});
    const SurfaceMesh moved = transformed(truth, T_truth_mesh.inverse());
    EXPECT_GT(score_surface(moved, truth, 5'000).mean_mm, 5.0);
    const Eigen::Isometry3f found = align_to_truth(moved, truth, Eigen::Isometry3f::Identity());
    EXPECT_LT((found.translation() - T_truth_mesh.translation()).norm(), 1e-4f);
    EXPECT_LT(Eigen::AngleAxisf(found.linear().transpose() * T_truth_mesh.linear()).angle(), 3e-4f);
}

TEST(SurfaceScore, AlignmentLeavesOutWhatTheTruthHasNot) {
    const SurfaceMesh truth = odd_body();
    const auto box = test::box_distance(middle_m, {0.16f, 0.11f, 0.07f});
    const auto ball = test::sphere_distance(middle_m + Eigen::Vector3f(0.14f, 0.06f, 0.09f), 0.06f);
    const auto finger =
        test::box_distance(middle_m + Eigen::Vector3f(-0.2f, 0.0f, 0.0f), {0.08f, 0.02f, 0.02f});
    const SurfaceMesh mesh = mesh_of([&](const Eigen::Vector3f& p) {
        return std::min({box(p), ball(p), finger(p)});
    });
    const Eigen::Isometry3f T_truth_mesh = motion(-0.08f, {0.01f, 0.01f, -0.01f});
    const Eigen::Isometry3f found =
        align_to_truth(transformed(mesh, T_truth_mesh.inverse()), truth, Eigen::Isometry3f::Identity());
    EXPECT_LT((found * T_truth_mesh.inverse() * middle_m - middle_m).norm(), 3e-4f);
}

TEST(SurfaceScore, ASphereIsAlignedWithoutTurning) {
    const SurfaceMesh truth = sphere(0.2f);
    const Eigen::Isometry3f T_truth_mesh = motion(0.0f, {0.02f, -0.01f, 0.01f});
    const Eigen::Isometry3f found =
        align_to_truth(transformed(truth, T_truth_mesh.inverse()), truth, Eigen::Isometry3f::Identity());
    EXPECT_LT((found * T_truth_mesh.inverse() * middle_m - middle_m).norm(), 2e-4f);
    EXPECT_LT(Eigen::AngleAxisf(found.linear()).angle(), 1e-4f);
}

TEST(SurfaceScore, FilesAreReadInTheirFrameAndScale) {
    const TemporaryFolder folder;
    SurfaceMesh mesh = odd_body();
    mesh.colors.assign(mesh.vertices_g_m.size(), {10, 20, 30});
    for (const char* name : {"a.ply", "a.obj", "a.stl"}) {
        write_mesh(folder / name, mesh);
        const SurfaceMesh read = read_mesh(folder / name);
        EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
        EXPECT_EQ(read.vertices_g_m.size(), mesh.vertices_g_m.size());
        EXPECT_EQ(test::topology_of(read).open_edges, 0) << name << ": equal vertices are one";
        EXPECT_LT(score_surface(read, mesh, 2'000).mean_mm, 0.001);
        if (std::string(name) == "a.stl") continue;
        EXPECT_EQ(read.colors.at(0), (std::array<std::uint8_t, 3>{10, 20, 30}));
    }
    const SurfaceMesh large = read_mesh(folder / "a.ply", 2.0f);
    EXPECT_NEAR(test::topology_of(large).volume_m3, 8.0 * test::topology_of(mesh).volume_m3, 1e-6);
    expect_error([&] { read_mesh(folder / "b.ply"); }, ExitStatus::no_input, ::testing::HasSubstr("b.ply"));
    write_mesh(folder / "empty.ply", SurfaceMesh{});
    expect_error([&] { read_mesh(folder / "empty.ply"); }, ExitStatus::bad_data,
                 ::testing::HasSubstr("empty"));
}

TEST(SurfaceScore, FiguresAsJson) {
    SurfaceScore score;
    score.mean_mm = 1.25;
    score.share_over_10_mm = 0.5;
    score.completeness_5_mm = 0.75;
    const auto json = nlohmann::json::parse(json_of(score));
    EXPECT_EQ(json["accuracy"]["mean_mm"], 1.25);
    EXPECT_EQ(json["accuracy"]["share_over_10_mm"], 0.5);
    EXPECT_EQ(json["completeness"]["share_within_5_mm"], 0.75);
}

}  // namespace
}  // namespace touchstone
