#include <gtest/gtest.h>

#include "pipeline/volumetric_integration.hpp"
#include "tests/reference/listing_2.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"
#include "tests/support/small_volume.hpp"

namespace touchstone {
namespace {

constexpr AdaptiveWeightParams adaptive{0.5f, 0.75f, 2.5f, 1};

/// A ball that comes nearer and wobbles before a wall. Weights: 8 on the ball, free space only on the wall's
/// left, nothing on its right.
struct Frame {
    Frame(const Intrinsics& k, int number) {
        const float near_m = 0.004f * static_cast<float>(number);
        const auto ball = test::sphere({0.002f * static_cast<float>(number % 3), 0.0f, 0.6f - near_m}, 0.1f);
        depth_m = test::render_depth_m(k, test::both(ball, test::plane({0.0f, 0.0f, 1.0f}, 0.7f)));
        for (std::size_t i = 0; i < depth_m.size(); ++i) {
            const bool left = static_cast<int>(i) % k.width_px < k.width_px / 2;
            const bool on_ball = depth_m[i] < 0.69f;
            own.push_back(on_ball ? 8 : 0);
            all.push_back(on_ball ? 8 : left ? SAMPLE_FREE_ONLY : 0);
        }
    }
    std::vector<float> depth_m;
    std::vector<std::uint8_t> own, all;
};

class MovingVolumes : public testing::Test {
  protected:
    void fuse(const Frame& frame) {
        const Buffer<float> depth(device, test::padded<float>(shape, frame.depth_m));
        const Buffer<std::uint8_t> own(device, test::padded<std::uint8_t>(shape, frame.own));
        const Buffer<std::uint8_t> all(device, test::padded<std::uint8_t>(shape, frame.all));
        integration.integrate_moving(volume, depth, own, all, T_g_c, all_layers(volume), adaptive);
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera();
    MapShape shape = make_map_shape(k);
    RigidTransform T_g_c = test::pose_in_front();
    TsdfVolume volume{device, test::small_volume(100)};
    VolumetricIntegration integration{device, k};
};

/// TSDF within 3 of 32766 steps, equal weight and change within one step of it, in every brick that there is
/// from the first frame on. A voxel that projects on the border of two pixels may round to either: 1 % of
/// those known may differ.
TEST_F(MovingVolumes, AdaptiveWeightAgreesWithTheReference) {
    reference::DenseVolume dense(volume.params());
    std::vector<std::uint8_t> old_brick(volume.brick_count(), 0);
    for (int number = 0; number < 6; ++number) {
        const Frame frame(k, number);
        fuse(frame);
        reference::integrate_moving(dense, adaptive, frame.depth_m, frame.all, k, T_g_c);
        if (number > 0) continue;
        for (std::size_t brick = 0; brick < old_brick.size(); ++brick)
            old_brick[brick] = volume.slot(static_cast<int>(brick)) >= 0;
    }
    const std::vector<int> pool = volume.pool().read();
    const int n = volume.params().size_vox, side = volume.params().bricks_per_side;
    int known = 0, differing = 0, adapted = 0;
    for (int z = 0; z < n; ++z) {
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                const int brick = ((z / 8) * side + y / 8) * side + x / 8;
                if (old_brick[static_cast<std::size_t>(brick)] == 0) continue;
                const int offset = ((z & 7) * 8 + (y & 7)) * 8 + (x & 7);
                const int packed = pool[static_cast<std::size_t>(volume.slot(brick) * BRICK_VOXELS + offset)];
                const reference::Voxel expected = dense.at(x, y, z);
                const float tsdf =
                    static_cast<float>(static_cast<std::int16_t>(packed & 0xffff)) / TSDF_SCALE;
                const int weight = packed >> 16 & 0xff, change = packed >> 24;
                known += expected.weight > 0;
                adapted += expected.weight > 0 && expected.weight < 20 && expected.change != 0;
                differing += weight != expected.weight || std::abs(change - expected.change) > 1 ||
                             (weight > 0 && std::abs(tsdf - expected.tsdf) > 3.0f / TSDF_SCALE);
            }
        }
    }
    EXPECT_GT(known, 5000);
    EXPECT_GT(adapted, 1000) << "the scene does move";
    EXPECT_LT(differing, known / 100);
}

TEST_F(MovingVolumes, FreeSpaceAllocatesNothingAndTakesAwayWhatLeft) {
    Frame frame(k, 0);
    fuse(frame);
    const int bricks = volume.bricks_in_use();
    EXPECT_GT(bricks, 0);
    std::ranges::fill(frame.depth_m, 0.7f);
    std::ranges::fill(frame.own, std::uint8_t{0});
    std::ranges::fill(frame.all, std::uint8_t{SAMPLE_FREE_ONLY});
    fuse(frame);
    fuse(frame);
    EXPECT_EQ(volume.bricks_in_use(), bricks);
    // The front of the ball is in free space; its rim is within the truncation of the wall, where nobody
    // knows.
    const std::vector<std::uint8_t> has_inside = volume.has_inside().read();
    const auto inside = std::count(has_inside.begin(), has_inside.begin() + bricks, 1);
    EXPECT_LT(inside, bricks / 4);
}

TEST_F(MovingVolumes, BricksMoveWithTheirVoxels) {
    fuse(Frame(k, 0));
    const std::vector<int> before = volume.pool().read();
    const int side = volume.params().bricks_per_side;
    std::vector<int> slot_before(volume.brick_count());
    for (std::size_t brick = 0; brick < slot_before.size(); ++brick)
        slot_before[brick] = volume.slot(static_cast<int>(brick));
    const auto count = static_cast<std::size_t>(volume.bricks_in_use());
    std::vector<std::uint8_t> kept(count, 1);
    kept[0] = 0;
    volume.rearrange(kept, {3, 0, -1});
    const std::vector<int> after = volume.pool().read(), table = volume.table().read();
    int moved = 0;
    for (int brick = 0; brick < static_cast<int>(slot_before.size()); ++brick) {
        const int from_slot = slot_before[static_cast<std::size_t>(brick)];
        const int x = brick % side + 3, z = brick / (side * side) - 1;
        if (from_slot <= 0 || x >= side || z < 0) continue;
        const int slot = volume.slot(brick + 3 - side * side);
        ASSERT_GE(slot, 0);
        EXPECT_EQ(table[static_cast<std::size_t>(brick + 3 - side * side)], slot);
        const auto from = before.begin() + static_cast<std::ptrdiff_t>(from_slot) * BRICK_VOXELS;
        EXPECT_TRUE(std::equal(from, from + BRICK_VOXELS,
                               after.begin() + static_cast<std::ptrdiff_t>(slot) * BRICK_VOXELS));
        ++moved;
    }
    EXPECT_EQ(volume.bricks_in_use(), moved);
    EXPECT_GT(moved, 10);
    EXPECT_EQ(std::ranges::count_if(table, [](int slot) { return slot >= 0; }), moved);
    const auto rest = after.begin() + static_cast<std::ptrdiff_t>(moved) * BRICK_VOXELS;
    EXPECT_TRUE(std::all_of(rest, rest + BRICK_VOXELS, [](int voxel) { return voxel == 0; }))
        << "a slot that is free again is unknown";
}

}  // namespace
}  // namespace touchstone
