#include "pipeline/moving_volume.hpp"

#include <gtest/gtest.h>

#include "pipeline/raycasting.hpp"
#include "tests/support/moving_things.hpp"

namespace touchstone {
namespace {

class MovingVolumeTest : public testing::Test {
  protected:
    MovingVolumeTest() {
        things.show({thing_at(0.0f)});
        points = sample();
    }
    static RigidTransform thing_at(float x_m) {
        RigidTransform T_o_c = RigidTransform::Identity();
        T_o_c.translation() = Eigen::Vector3f(-x_m, 0.0f, -0.8f);
        return T_o_c;
    }
    ComponentPoints sample() {
        ComponentPoints result;
        for (int y = 0; y < k.height_px; y += 2) {
            for (int x = 0; x < k.width_px; x += 2) {
                const float z = things.exact_m[static_cast<std::size_t>(y * k.width_px + x)];
                if (z > 0.0f) result.at_c_m.emplace_back(z * test::pixel_ray(k, x, y));
            }
        }
        return result;
    }
    void fuse(MovingVolume& volume) {
        Buffer<std::uint8_t> weights(device, map_pixels(shape));
        weights.fill(8);
        integration.integrate_moving(volume.volume(), things.live.depth_m, weights, weights, volume.T_g_c(),
                                     all_layers(volume.volume()), {0.5f, 0.75f, 2.5f, 1});
    }
    std::vector<float> predicted_m(MovingVolume& volume) {
        raycasting.raycast(volume.volume(), volume.T_g_c(), volume.prediction);
        return test::cropped(shape, volume.prediction.depth_m.read());
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(160, 120);
    MapShape shape = make_map_shape(k);
    test::MovingThings things{device, k};
    VolumetricIntegration integration{device, k};
    Raycasting raycasting{device, k};
    VolumeConfig config{96, 0.48f, 3.0f, 2.5f, 0.0f, 128, 3000};
    ComponentPoints points;
};

TEST_F(MovingVolumeTest, TheCubeFollowsByWholeBricksAndTheSurfaceStaysWhereItIs) {
    MovingVolume volume(device, config, shape, 0, points);
    fuse(volume);
    const std::vector<float> before = predicted_m(volume);
    ComponentPoints reaching = points;
    for (const Eigen::Vector3f& point : points.at_c_m)
        reaching.at_c_m.emplace_back(point + Eigen::Vector3f(0.12f, 0.0f, 0.0f));
    const RigidTransform T_g_c = volume.T_g_c();
    volume.follow(reaching);
    const Eigen::Vector3f shift = (volume.T_g_c().translation() - T_g_c.translation()) / 0.04f;
    EXPECT_LT(shift.x(), -0.5f);
    EXPECT_NEAR(shift.x(), std::round(shift.x()), 1e-3f);
    const std::vector<float> after = predicted_m(volume);
    int seen = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_NEAR(before[i], after[i], 1e-4f) << i;
        seen += before[i] > 0.0f;
    }
    EXPECT_GT(seen, 500);
}

TEST_F(MovingVolumeTest, StaysWhileThePointsAreWellInside) {
    MovingVolume volume(device, config, shape, 0, points);
    const RigidTransform T_g_c = volume.T_g_c();
    volume.follow(points);
    EXPECT_TRUE(T_g_c.isApprox(volume.T_g_c()));
}

TEST_F(MovingVolumeTest, BricksOfWhatLeftAreForgottenAndTheSurfaceKept) {
    MovingVolume volume(device, config, shape, 0, points);
    fuse(volume);
    const int bricks = volume.volume().bricks_in_use();
    const std::vector<float> before = predicted_m(volume);
    volume.prune();
    EXPECT_LE(volume.volume().bricks_in_use(), bricks);
    EXPECT_EQ(predicted_m(volume), before);
    // A wall far behind all of it: every voxel is in free space.
    std::vector<float> wall_m(map_pixels(shape), 2.0f);
    things.live.depth_m.write(wall_m);
    for (int frame = 0; frame < 3; ++frame) fuse(volume);
    volume.prune();
    EXPECT_EQ(volume.volume().bricks_in_use(), 0);
    EXPECT_EQ(std::ranges::count(predicted_m(volume), 0.0f), 160 * 120);
}

TEST_F(MovingVolumeTest, LayersHoldThePoints) {
    const MovingVolume volume(device, config, shape, 0, points);
    const BrickLayers layers = volume.layers(points);
    for (const Eigen::Vector3f& point_c : points.at_c_m) {
        const int layer = static_cast<int>((volume.T_g_c() * point_c).y() / 0.04f);
        EXPECT_GE(layer, layers.first);
        EXPECT_LT(layer, layers.first + layers.count);
    }
    EXPECT_LT(layers.count, volume.volume().params().bricks_per_side);
}

}  // namespace
}  // namespace touchstone
