#include "pipeline/object_segmentation.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "pipeline/mesh_file.hpp"
#include "pipeline/scan_file.hpp"
#include "pipeline/surface_mesh.hpp"
#include "tests/support/object_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using test::ObjectScene;
using test::Slab;

constexpr Slab box{70, 60, 110, 100, 0.93f};
constexpr Slab arm{80, 70, 120, 160, 0.85f};  // enters the picture at its lower border

TEST(ObjectSegmentation, WhatIsPutDownBecomesBackgroundAfterItsTime) {
    ObjectScene scene;
    scene.scan({});
    EXPECT_EQ(scene.show_for(8, {box}).settled, 0);
    EXPECT_NEAR(scene.predicted_m(90, 80), 1.0f, 0.002f);
    EXPECT_EQ(scene.show_for(8, {box}).settled, 1);
    EXPECT_NEAR(scene.predicted_m(90, 80), 0.93f, 0.002f);
    EXPECT_NEAR(scene.predicted_m(60, 120), 1.0f, 0.002f);
    EXPECT_EQ(scene.show_for(30, {box}).settled, 0) << "once is enough";
    EXPECT_EQ(scene.foreground_components, 0);
}

TEST(ObjectSegmentation, TheSurfaceBeforeIsBackToTheBitWhenItGoes) {
    ObjectScene scene;
    scene.scan({});
    scene.show_for(40, {});
    const VolumeSnapshot volume = take_snapshot(scene.background->volume());
    const std::vector<float> depth = scene.background->prediction().depth_m.read();
    const std::vector<float> normals = scene.background->prediction().normals_c.read();
    // What lies in the open goes on being averaged, so only what the box covers is compared.
    EXPECT_EQ(scene.show_for(40, {box}).settled, 1);
    const ObjectChanges changes = scene.show_for(2, {});
    EXPECT_EQ(changes.taken, 1);
    EXPECT_TRUE(changes.lifted.empty());
    EXPECT_TRUE(scene.background->settled().empty());
    const std::vector<float> depth_after = scene.background->prediction().depth_m.read();
    const std::vector<float> normals_after = scene.background->prediction().normals_c.read();
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const std::size_t at = map_index(scene.shape, x, y);
            ASSERT_EQ(depth_after[at], depth[at]) << x << " " << y;
            ASSERT_EQ(normals_after[at], normals[at]);
        }
    }
    EXPECT_EQ(take_snapshot(scene.background->volume()).bricks, volume.bricks)
        << "a brick of the box is left";
    EXPECT_TRUE(scene.show_for(30, {}).lifted.empty()) << "nothing of the scan was taken away";
}

TEST(ObjectSegmentation, AHandThatRestsIsNoObject) {
    ObjectScene scene;
    scene.scan({});
    EXPECT_EQ(scene.show_for(40, {arm}).settled, 0);
}

TEST(ObjectSegmentation, APieceBesideAnArmWaitsUntilItIsGone) {
    ObjectScene scene;
    scene.scan({});
    const Slab piece{70, 40, 100, 64, 0.93f};
    EXPECT_EQ(scene.show_for(40, {arm, piece}).settled, 0);
    EXPECT_EQ(scene.show_for(30, {piece}).settled, 1);
}

TEST(ObjectSegmentation, WhatIsTouchedOrMovesIsNoObject) {
    ObjectScene scene;
    scene.scan({});
    TouchEvent touch;
    touch.phase = TouchPhase::move;
    touch.tip.pixel_px = {90.0f, 80.0f};
    const Slab finger{86, 70, 94, 90, 0.86f};
    EXPECT_EQ(scene.show_for(40, {box, finger}, {touch}).settled, 0);
    for (int step = 0; step < 40; ++step) {
        const Slab moving{40 + step, 60, 70 + step, 90, 0.93f};
        EXPECT_EQ(scene.show({moving}).settled, 0) << step;
    }
}

TEST(ObjectSegmentation, ItsOwnCornerIsNoFinger) {
    ObjectScene scene;
    scene.scan({});
    TouchEvent corner;
    corner.phase = TouchPhase::move;
    corner.tip.pixel_px = {90.0f, 80.0f};
    EXPECT_EQ(scene.show_for(40, {box}, {corner}).settled, 1);
}

TEST(ObjectSegmentation, AnObjectOnAnotherAndItsWayBack) {
    ObjectScene scene;
    scene.scan({});
    EXPECT_EQ(scene.show_for(40, {box}).settled, 1);
    const Slab upper{80, 70, 100, 90, 0.88f};
    EXPECT_EQ(scene.show_for(40, {box, upper}).settled, 1);
    EXPECT_NEAR(scene.predicted_m(90, 80), 0.88f, 0.002f);
    EXPECT_EQ(scene.show_for(3, {box}).taken, 1);
    EXPECT_NEAR(scene.predicted_m(90, 80), 0.93f, 0.002f);
    EXPECT_EQ(scene.show_for(3, {}).taken, 1);
    EXPECT_NEAR(scene.predicted_m(90, 80), 1.0f, 0.002f);
}

TEST(ObjectSegmentation, APushedObjectIsNotKeptWhereItWas) {
    ObjectScene scene;
    scene.scan({});
    EXPECT_EQ(scene.show_for(40, {box}).settled, 1);
    const Slab pushed{75, 60, 115, 100, 0.93f};
    EXPECT_EQ(scene.show_for(60, {pushed}).taken, 1);
    EXPECT_NEAR(scene.predicted_m(72, 80), 1.0f, 0.002f);
    EXPECT_NEAR(scene.predicted_m(112, 80), 0.93f, 0.002f) << "it settled where it is now";
}

TEST(ObjectSegmentation, FiftyTimesPutDownAndTakenLeaveNothing) {
    ObjectScene scene;
    scene.scan({});
    scene.show_for(10, {});
    const int bricks = scene.background->volume().bricks_in_use();
    const std::size_t bytes = scene.background->volume().memory_bytes();
    for (int cycle = 0; cycle < 50; ++cycle) {
        const Slab thing{60 + cycle % 7, 60, 90 + cycle % 7, 90, 0.93f};
        EXPECT_EQ(scene.show_for(16, {thing}).settled, 1) << cycle;
        EXPECT_EQ(scene.show_for(3, {}).taken, 1) << cycle;
        ASSERT_EQ(scene.background->settled().memory_bytes(), 0u);
    }
    EXPECT_EQ(scene.background->volume().bricks_in_use(), bricks);
    EXPECT_EQ(scene.background->volume().memory_bytes(), bytes);
    const SurfaceMesh mesh = extract_surface(take_snapshot(scene.background->volume()), {1, 0});
    // The wall, within two voxels.
    for (const Eigen::Vector3f& vertex : mesh.vertices_g_m) ASSERT_NEAR(vertex.z(), 0.45f, 0.01f);
}

TEST(ObjectSegmentation, WhatIsLiftedOutOfTheScanIsCutOutAndTheRestStays) {
    TemporaryFolder folder;
    ObjectsConfig config = ObjectScene::fast();
    config.export_dir = (folder / "objects").string();
    ObjectScene scene(config);
    const Slab thing{70, 60, 110, 100, 0.95f};
    scene.scan({thing});
    EXPECT_NEAR(scene.predicted_m(90, 80), 0.95f, 0.002f);
    const VolumeSnapshot before = take_snapshot(scene.background->volume());
    std::vector<VolumeSnapshot> lifted;
    VolumeSnapshot after;
    int frames = 0;
    while (lifted.empty() && frames < 30) {
        lifted = scene.show({}).lifted;
        ++frames;
    }
    ASSERT_EQ(lifted.size(), 1u);
    EXPECT_LE(frames, 30) << "within a second";
    EXPECT_NEAR(scene.predicted_m(90, 80), 1.0f, 0.002f) << "the wall is there at once";
    EXPECT_TRUE(std::filesystem::exists(folder / "objects/object-001.ply"));
    EXPECT_EQ(load_scan(folder / "objects/object-001.scan").volume.bricks, lifted[0].bricks);
    const SurfaceMesh mesh = extract_surface(lifted[0]);
    ASSERT_GT(mesh.triangles.size(), 100u);
    for (const Eigen::Vector3f& vertex : mesh.vertices_g_m) {
        EXPECT_NEAR(vertex.z(), 0.40f, 0.008f);
        const Eigen::Vector3f p_c = scene.background->T_g_c().inverse() * vertex;
        const float u = p_c.x() / p_c.z() * scene.k.fx_px + scene.k.cx_px;
        EXPECT_TRUE(u > 66.0f && u < 114.0f) << u;
    }
    EXPECT_EQ(scene.show_for(30, {}).lifted.size(), 0u) << "once is enough";
}

/// Voxels that no ray of the lifted thing's outline, three pixels wider, passes through.
TEST(ObjectSegmentation, CuttingChangesNothingElseByABit) {
    ObjectScene scene;
    const Slab thing{70, 60, 110, 100, 0.95f};
    scene.scan({thing});
    const VolumeSnapshot before = take_snapshot(scene.background->volume());
    UncoveredSurface uncovered;
    uncovered.mean.box = {62, 52, 118, 108};
    const auto size =
        static_cast<std::size_t>(uncovered.mean.box.width_px() * uncovered.mean.box.height_px());
    uncovered.mean.depth_m.assign(size, 1.0f);
    uncovered.mean.samples.assign(size, 8);
    uncovered.inside.assign(size, 0);
    for (int y = thing.y0; y < thing.y1; ++y)
        for (int x = thing.x0; x < thing.x1; ++x) uncovered.inside[uncovered.mean.index(x, y)] = 1;
    const std::vector<float> predicted_m = scene.background->prediction().depth_m.read();
    ObjectFrame frame{};
    frame.intrinsics = scene.k;
    frame.shape = scene.shape;
    frame.predicted_m = predicted_m;
    scene.background->cut_out(uncovered, frame);
    const VolumeSnapshot after = take_snapshot(scene.background->volume());
    const float voxel_m = before.config.side_m / static_cast<float>(before.config.size_vox);
    const int side = before.config.size_vox / BRICK_VOX;
    int changed = 0, kept = 0;
    for (std::size_t i = 0; i < before.bricks.size(); ++i) {
        const auto there = std::ranges::lower_bound(after.bricks, before.bricks[i]);
        ASSERT_TRUE(there != after.bricks.end() && *there == before.bricks[i]);
        const auto j = static_cast<std::size_t>(there - after.bricks.begin());
        const int brick = before.bricks[i];
        for (int voxel = 0; voxel < BRICK_VOXELS; ++voxel) {
            const Eigen::Vector3i at(brick % side * 8 + (voxel & 7),
                                     brick / side % side * 8 + (voxel >> 3 & 7),
                                     brick / side / side * 8 + (voxel >> 6));
            const Eigen::Vector3f p_c =
                scene.background->T_g_c().inverse() * ((at.cast<float>().array() + 0.5f).matrix() * voxel_m);
            const float u = p_c.x() / p_c.z() * scene.k.fx_px + scene.k.cx_px;
            const float v = p_c.y() / p_c.z() * scene.k.fy_px + scene.k.cy_px;
            const auto from = i * BRICK_VOXELS + static_cast<std::size_t>(voxel);
            const auto to = j * BRICK_VOXELS + static_cast<std::size_t>(voxel);
            if (u < 66.0f || u > 114.0f || v < 56.0f || v > 104.0f) {
                ASSERT_EQ(after.voxels[to], before.voxels[from]);
                ++kept;
            } else {
                changed += after.voxels[to] != before.voxels[from];
            }
        }
    }
    EXPECT_GT(kept, 10000);
    EXPECT_GT(changed, 1000);
}

TEST(ObjectSegmentation, AHandBeforeTheLiftedThingsPlaceIsWaitedFor) {
    ObjectScene scene;
    const Slab thing{70, 60, 110, 100, 0.95f};
    scene.scan({thing});
    EXPECT_TRUE(scene.show_for(20, {arm}).lifted.empty());
    EXPECT_EQ(scene.show_for(30, {}).lifted.size(), 1u);
}

}  // namespace
}  // namespace touchstone
