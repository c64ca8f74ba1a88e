// What rests is not fused, what changes or is new is: on walls whose tiles are of one kind each.
#include "pipeline/resting_tiles.hpp"

#include <functional>
#include <gtest/gtest.h>

#include "pipeline/background_model.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

constexpr RestingTilesConfig quick{.rest_sigmas = 0.2f, .mean_share = 0.5f, .young_frames = 4, .period = 7};
constexpr SensorNoise kinect{0.0012f, 0.0019f, 0.4f, 0.0001f};

class RestingTilesTest : public testing::Test {
  protected:
    using Depth = std::function<float(int tile)>;

    std::vector<float> picture(const Depth& depth_m) const {
        std::vector<float> result;
        for (int y = 0; y < k.height_px; ++y)
            for (int x = 0; x < k.width_px; ++x) result.push_back(depth_m(tile_of(x, y)));
        return test::padded<float>(shape, result);
    }
    int tile_of(int x, int y) const { return y / TILE_PX * tiles_per_row(shape) + x / TILE_PX; }
    /// Whether the tiles' weights are left, 9 of 10 of them being 1.
    std::vector<bool> left(const Depth& live_m, const Depth& model_m) {
        live.depth_m.write(picture(live_m));
        model.depth_m.write(picture(model_m));
        std::vector<std::uint8_t> before(map_pixels(shape), 0);
        for (std::size_t i = 0; i < before.size(); ++i) before[i] = i % 10 != 0;
        Buffer<std::uint8_t> weights(device, before);
        tiles.leave_out(live, model, weights);
        const std::vector<std::uint8_t> after = weights.read();
        std::vector<bool> result(static_cast<std::size_t>(tile_count(shape)));
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) {
                const std::size_t at = map_index(shape, x, y);
                if (before[at] == 0) continue;
                result[static_cast<std::size_t>(tile_of(x, y))] = after[at] != 0;
                EXPECT_TRUE(after[at] == 0 || after[at] == before[at]);
            }
        }
        return result;
    }
    int count_left(const Depth& live_m, const Depth& model_m) {
        return static_cast<int>(std::ranges::count(left(live_m, model_m), true));
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(160, 96);
    MapShape shape = make_map_shape(k);
    LiveMaps live{device, shape};
    SurfacePrediction model{device, shape};
    RestingTiles tiles{device, quick, kinect, shape};
    const Depth wall = [](int) { return 1.0f; };
};

/// 60 tiles; the 7 turns of a period take each tile once.
TEST_F(RestingTilesTest, WhatAgreesRestsOnceItIsOldAndHasItsTurns) {
    for (int frame = 0; frame < 4; ++frame) EXPECT_EQ(count_left(wall, wall), 60);
    std::vector<int> turns(60, 0);
    for (int frame = 0; frame < 7; ++frame) {
        const std::vector<bool> now = left(wall, wall);
        for (std::size_t tile = 0; tile < turns.size(); ++tile) turns[tile] += now[tile];
    }
    EXPECT_EQ(turns, std::vector<int>(60, 1));
    tiles.restart();
    EXPECT_EQ(count_left(wall, wall), 60);
}

/// sigma_z is 1.9 mm: tile 21 is 0.8 mm off (0.42 sigma), tile 22 is 0.2 mm off, tile 23 has no model, tile
/// 24 is not seen.
TEST_F(RestingTilesTest, WhatDisagreesOrHasNoModelIsFused) {
    const Depth seen = [](int tile) {
        return tile == 21 ? 1.0008f : tile == 22 ? 1.0002f : tile == 24 ? 0.0f : 1.0f;
    };
    const Depth known = [](int tile) { return tile == 23 ? 0.0f : 1.0f; };
    for (int frame = 0; frame < 10; ++frame) count_left(seen, known);
    std::vector<int> turns(60, 0);
    for (int frame = 0; frame < 7; ++frame) {
        const std::vector<bool> now = left(seen, known);
        for (std::size_t tile = 0; tile < turns.size(); ++tile) turns[tile] += now[tile];
    }
    EXPECT_EQ(turns[21], 7);
    EXPECT_EQ(turns[22], 1);
    EXPECT_EQ(turns[23], 7);
    EXPECT_EQ(turns[20], 1);
    for (int frame = 0; frame < 10; ++frame) count_left(wall, wall);
    EXPECT_LE(count_left(wall, wall), 10) << "what agrees again rests again";
}

/// The background of a wall that has come to rest is the same to the bit but for a turn now and then; a wall
/// that moved by 6 mm is followed as before.
TEST_F(RestingTilesTest, TheBackgroundOfARestingWallIsLeftAlone) {
    BackgroundConfig config;
    config.volume.size_vox = 256;
    config.refresh_parts = 2;
    config.rest = quick;
    config.rest.period = 1 << 20;
    config.rest.rest_sigmas = 0.5f;  // voxels of 5 mm: the raycast is 0.3 mm off
    VolumePlacement placement{1.28f, RigidTransform::Identity()};
    placement.T_g_c.translation() = Eigen::Vector3f(0.64f, 0.64f, -0.36f);
    BackgroundModel background(device, config, k, placement);
    live.normals_c.fill(0.0f);
    live.depth_m.write(picture([](int) { return 0.7f; }));
    std::vector<std::uint8_t> border(map_pixels(shape), 255);  // where the volume's prediction ends
    for (int y = TILE_PX; y < k.height_px - TILE_PX; ++y)
        for (int x = TILE_PX; x < k.width_px - TILE_PX; ++x) border[map_index(shape, x, y)] = 0;
    const Buffer<std::uint8_t> mask(device, border);
    for (int frame = 0; frame < 10; ++frame) background.scan(live);
    for (int frame = 0; frame < 6; ++frame) background.follow(live, mask);
    const std::vector<int> rested = background.volume().pool().read();
    for (int frame = 0; frame < 8; ++frame) background.follow(live, mask);
    EXPECT_EQ(background.volume().pool().read(), rested);
    live.depth_m.write(picture([](int) { return 0.706f; }));
    for (int frame = 0; frame < 200; ++frame) background.follow(live, mask);
    const std::vector<float> predicted_m = background.prediction().depth_m.read();
    EXPECT_NEAR(predicted_m[map_index(shape, 80, 48)], 0.706f, 0.0015f);
}

}  // namespace
}  // namespace touchstone
