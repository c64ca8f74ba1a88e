#include "pipeline/background_model.hpp"

#include <gtest/gtest.h>

#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

TEST(FitVolume, HoldsWhatTheFirstFrameSees) {
    const Intrinsics k = test::small_camera(320, 240);
    const std::vector<float> depth_m =
        test::render_depth_m(k, test::plane(Eigen::Vector3f(0.0f, 0.4f, 1.0f).normalized(), 1.2f));
    const auto placement = fit_volume({test::to_mm(depth_m), k}, 4.5f);
    ASSERT_TRUE(placement.has_value());
    EXPECT_GE(placement->side_m, 1.0f);
    EXPECT_LE(placement->side_m, 5.0f);
    int outside = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const Eigen::Vector3f p_c =
                depth_m[static_cast<std::size_t>(y * k.width_px + x)] * test::pixel_ray(k, x, y);
            const Eigen::Vector3f p_g = placement->T_g_c * p_c;
            outside += p_g.minCoeff() < 0.0f || p_g.maxCoeff() > placement->side_m;
        }
    }
    EXPECT_LT(outside, k.width_px * k.height_px / 50);
}

TEST(FitVolume, SmallAndLargeScenesKeepTheSideWithinItsLimits) {
    const Intrinsics k = test::small_camera(160, 120);
    const auto pixels = static_cast<std::size_t>(k.width_px * k.height_px);
    EXPECT_FLOAT_EQ(fit_volume({std::vector<std::uint16_t>(pixels, 500), k}, 4.5f)->side_m, 1.0f);
    EXPECT_LE(fit_volume({std::vector<std::uint16_t>(pixels, 6000), k}, 8.0f)->side_m, 5.0f * 1.32f);
}

TEST(FitVolume, NothingSeenGivesNothing) {
    const Intrinsics k = test::small_camera(160, 120);
    const std::vector<std::uint16_t> empty(static_cast<std::size_t>(k.width_px * k.height_px), 0);
    EXPECT_FALSE(fit_volume({empty, k}, 4.5f).has_value());
}

TEST(PlaceVolume, ASideOfOnesOwnKeepsTheMiddle) {
    const Intrinsics k = test::small_camera(160, 120);
    const std::vector<std::uint16_t> wall(static_cast<std::size_t>(k.width_px * k.height_px), 1500);
    BackgroundConfig config;
    const auto fitted = place_volume({wall, k}, config);
    config.fit_side = false;
    config.volume.side_m = 3.5f;
    const auto given = place_volume({wall, k}, config);
    ASSERT_TRUE(fitted && given);
    EXPECT_EQ(given->side_m, 3.5f);
    EXPECT_LT(fitted->side_m, 3.0f);
    const auto middle_c = [](const VolumePlacement& placement) -> Eigen::Vector3f {
        return placement.T_g_c.inverse() * Eigen::Vector3f::Constant(0.5f * placement.side_m);
    };
    EXPECT_LT((middle_c(*fitted) - middle_c(*given)).norm(), 1e-5f);
}

class FollowTest : public testing::Test {
  protected:
    /// A wall; without normals, as where a surface is seen in single pixels only.
    LiveMaps wall(float depth_m) {
        const std::vector<float> picture(static_cast<std::size_t>(k.width_px * k.height_px), depth_m);
        LiveMaps live(device, shape);
        live.depth_m.write(test::padded<float>(shape, picture));
        live.normals_c.fill(0.0f);
        return live;
    }
    float center_depth_m(const BackgroundModel& model) {
        return model.prediction().depth_m.read()[map_index(shape, k.width_px / 2, k.height_px / 2)];
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(160, 120);
    MapShape shape = make_map_shape(k);
};

TEST_F(FollowTest, MovesWithASlowChangeButNotUnderTheMask) {
    BackgroundConfig config;
    config.volume.size_vox = 128;
    config.refresh_parts = 2;
    VolumePlacement placement{1.28f, RigidTransform::Identity()};
    placement.T_g_c.translation() = Eigen::Vector3f(0.64f, 0.64f, -0.36f);
    BackgroundModel model(device, config, k, placement);
    const LiveMaps before = wall(1.0f), after = wall(1.006f);
    for (int frame = 0; frame < 10; ++frame) model.scan(before);
    EXPECT_NEAR(center_depth_m(model), 1.0f, 0.001f);
    Buffer<std::uint8_t> mask(device, map_pixels(shape));
    mask.fill(255);
    for (int frame = 0; frame < 40; ++frame) model.follow(after, mask);
    EXPECT_NEAR(center_depth_m(model), 1.0f, 0.001f) << "masked pixels changed the background";
    mask.fill(0);
    for (int frame = 0; frame < 200; ++frame) model.follow(after, mask);
    EXPECT_NEAR(center_depth_m(model), 1.006f, 0.0015f);
}

/// Left half red, right half blue; a hand, green and masked, over the middle of the left half.
TEST_F(FollowTest, TheSurfaceTakesTheColoursOfThePictureButNotUnderTheMask) {
    BackgroundConfig config;
    config.volume.size_vox = 128;
    VolumePlacement placement{1.28f, RigidTransform::Identity()};
    placement.T_g_c.translation() = Eigen::Vector3f(0.64f, 0.64f, -0.36f);
    BackgroundModel model(device, config, k, placement);
    LiveMaps live = wall(1.0f);
    std::vector<float> facing(3 * map_pixels(shape), 0.0f);
    std::fill(facing.begin() + static_cast<std::ptrdiff_t>(2 * map_pixels(shape)), facing.end(), -1.0f);
    live.normals_c.write(facing);
    for (int frame = 0; frame < 10; ++frame) model.scan(live);
    EXPECT_EQ(model.volume().colors(), nullptr);

    std::vector<std::uint8_t> rgb, mask;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const bool hand = x >= 20 && x < 60 && y >= 40 && y < 80, left = x < 80;
            for (const int level : {left && !hand ? 200 : 10, hand ? 220 : 30, left ? 20 : 180})
                rgb.push_back(static_cast<std::uint8_t>(level));
            mask.push_back(hand ? 255 : 0);
        }
    }
    const Buffer<std::uint8_t> masked(device, test::padded<std::uint8_t>(shape, mask));
    for (int frame = 0; frame < 3 * config.refresh_parts * config.color_interval; ++frame)
        model.follow(live, masked, rgb);

    const VolumeSnapshot snapshot = take_snapshot(model.volume());
    int red = 0, blue = 0, other = 0;
    for (const std::uint32_t color : snapshot.colors) {
        if (color >> 24 == 0) continue;
        const std::uint32_t r = color & 255, g = color >> 8 & 255, b = color >> 16 & 255;
        red += r == 200 && g == 30 && b == 20;
        blue += r == 10 && g == 30 && b == 180;
        other += g > 35;
    }
    EXPECT_GT(red, 1000);
    EXPECT_GT(blue, 2000);
    EXPECT_EQ(other, 0) << "voxels with the colour of the hand";
}

}  // namespace
}  // namespace touchstone
