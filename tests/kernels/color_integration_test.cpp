#include "pipeline/color_integration.hpp"

#include <gtest/gtest.h>
#include <random>

#include "pipeline/volume_snapshot.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/fusion_chain.hpp"
#include "tests/support/global_scene.hpp"
#include "tests/support/small_volume.hpp"

namespace touchstone {
namespace {

using Rgb = std::array<int, 3>;
constexpr Rgb red{200, 40, 30}, blue{20, 60, 180}, green{30, 160, 50};

/// Colour of each point of the global frame.
using Paint = std::function<Rgb(const Eigen::Vector3f& p_g)>;

struct PaintedVoxel {
    Eigen::Vector3f p_g;
    Rgb color;
};

class ColorIntegrationTest : public testing::Test {
  protected:
    static RigidTransform at(float x_m, float z_m) {
        RigidTransform T_g_c = RigidTransform::Identity();
        T_g_c.translation() = Eigen::Vector3f(x_m, 0.32f, z_m);
        return T_g_c;
    }

    /// One frame; each channel off by up to `noise`, the colour picture `shift_px` columns to the left.
    void fuse(const test::Surface& scene, const Paint& paint, const RigidTransform& T_g_c, int noise = 0,
              int shift_px = 0) {
        const std::vector<float> depth_m = test::view_m(k, scene, T_g_c);
        std::uniform_int_distribution<int> off(-noise, noise);
        std::vector<std::uint8_t> rgb;
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) {
                const int from = std::clamp(x + shift_px, 0, k.width_px - 1);
                const float z_m = depth_m[static_cast<std::size_t>(y * k.width_px + from)];
                for (const int channel : paint(T_g_c * (z_m * test::pixel_ray(k, from, y))))
                    rgb.push_back(static_cast<std::uint8_t>(channel + off(random)));
            }
        }
        conversion.convert({test::to_mm(depth_m), k}, live);
        const Buffer<std::uint8_t>& weights = weighting.weigh(live);
        const std::vector<int>& bricks =
            integration.integrate(volume, live.depth_m, weights, T_g_c, all_layers(volume));
        coloring.integrate(volume, live, rgb, weights, T_g_c, bricks);
    }

    std::vector<PaintedVoxel> painted() const {
        const VolumeSnapshot snapshot = take_snapshot(volume);
        std::vector<PaintedVoxel> voxels;
        for (std::size_t i = 0; i < snapshot.colors.size(); ++i) {
            const std::uint32_t color = snapshot.colors[i];
            if (color >> 24 == 0) continue;
            const int brick = snapshot.color_bricks[i / BRICK_VOXELS],
                      in = static_cast<int>(i % BRICK_VOXELS);
            const Eigen::Vector3i cell(brick % 8 * 8 + in % 8, brick / 8 % 8 * 8 + in / 8 % 8,
                                       brick / 64 * 8 + in / 64);
            const auto channel = [&](int shift) { return static_cast<int>(color >> shift & 0xff); };
            voxels.push_back({0.01f * (cell.cast<float>() + Eigen::Vector3f::Constant(0.5f)),
                              {channel(0), channel(8), channel(16)}});
        }
        return voxels;
    }
    static int difference(const Rgb& a, const Rgb& b) {
        return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(236, 200);  // not whole tiles
    TsdfVolume volume{device, test::small_volume()};
    DepthMapConversion conversion{device, {}, k};
    SampleWeighting weighting{device, {}, k};
    VolumetricIntegration integration{device, k};
    ColorIntegration coloring{device, {}, k};
    LiveMaps live{device, make_map_shape(k)};
    std::mt19937 random{3};
    test::Surface wall = test::box({-9.0f, -9.0f, 0.4f}, {9.0f, 9.0f, 0.6f});
};

TEST_F(ColorIntegrationTest, TwoColoredWallComesBackNearItsSurfaceOnly) {
    const auto paint = [](const Eigen::Vector3f& p_g) { return p_g.x() < 0.32f ? red : blue; };
    for (int frame = 0; frame < 30; ++frame) fuse(wall, paint, at(0.32f, -0.1f), 20);
    int compared = 0;
    std::array<double, 3> off{};
    for (const PaintedVoxel& voxel : painted()) {
        ASSERT_LT(std::abs(voxel.p_g.z() - 0.4f), 0.0155f) << "1.5 voxels";
        if (std::abs(voxel.p_g.x() - 0.32f) < 0.01f) continue;
        const Rgb expected = paint(voxel.p_g);
        ASSERT_LT(difference(voxel.color, expected), 16) << "a mean of eight frames or more of +-20";
        for (std::size_t channel = 0; channel < 3; ++channel)
            off[channel] += voxel.color[channel] - expected[channel];
        ++compared;
    }
    EXPECT_GT(compared, 3500);
    for (const double sum : off) EXPECT_LT(std::abs(sum / compared), 1.0) << "grey levels";
}

TEST_F(ColorIntegrationTest, WithoutNoiseColorsAreExactAndFollowAChange) {
    fuse(
        wall, [](const auto&) { return red; }, at(0.32f, -0.1f));
    for (const PaintedVoxel& voxel : painted()) ASSERT_EQ(voxel.color, red);
    for (int frame = 0; frame < 60; ++frame)
        fuse(
            wall, [](const auto&) { return green; }, at(0.32f, -0.1f));
    ASSERT_GT(painted().size(), 3500u);
    for (const PaintedVoxel& voxel : painted())
        ASSERT_LE(difference(voxel.color, green), 4) << "half of a step of 8";
}

TEST_F(ColorIntegrationTest, NoColorGoesOverADepthEdge) {
    const test::Surface thing = test::box({0.22f, 0.22f, 0.2f}, {0.42f, 0.42f, 0.25f});
    const auto paint = [](const Eigen::Vector3f& p_g) { return p_g.z() < 0.3f ? red : blue; };
    // The colour picture is two pixels off, to either side.
    for (int frame = 0; frame < 6; ++frame)
        fuse(test::nearest({thing, wall}), paint, at(0.27f + 0.02f * static_cast<float>(frame), -0.1f), 0,
             frame % 2 == 0 ? 2 : -2);
    int on_thing = 0, on_wall = 0;
    for (const PaintedVoxel& voxel : painted()) {
        const bool is_thing = voxel.p_g.z() < 0.3f;
        (is_thing ? on_thing : on_wall) += 1;
        ASSERT_EQ(voxel.color, is_thing ? red : blue) << voxel.p_g.transpose();
    }
    EXPECT_GT(on_thing, 300);
    EXPECT_GT(on_wall, 500);
}

TEST_F(ColorIntegrationTest, SurfacesSeenAslantGiveNoColor) {
    const auto tilted = [](float degrees) -> test::Surface {
        const float tilt_rad = degrees * 3.14159265f / 180.0f;
        return [=](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
            const Eigen::Vector3f n(0.0f, std::sin(tilt_rad), std::cos(tilt_rad)), p(0.32f, 0.32f, 0.32f);
            return std::max(0.0f, n.dot(p - origin) / n.dot(direction));
        };
    };
    k.fx_px = k.fy_px = 2000.0f;  // all rays nearly alike
    ColorIntegration narrow(device, {}, k);
    const auto colored = [&](float degrees) {
        TsdfVolume own(device, test::small_volume());
        const RigidTransform T_g_c = at(0.32f, -1.0f);
        DepthMapConversion(device, {}, k)
            .convert({test::to_mm(test::view_m(k, tilted(degrees), T_g_c)), k}, live);
        SampleWeighting weights(device, {}, k);
        const Buffer<std::uint8_t>& map = weights.weigh(live);
        VolumetricIntegration fusion(device, k);
        const std::vector<int>& bricks = fusion.integrate(own, live.depth_m, map, T_g_c, all_layers(own));
        narrow.integrate(own, live, std::vector<std::uint8_t>(3 * 236 * 200, 99), map, T_g_c, bricks);
        int count = 0;
        for (const std::uint32_t color : take_snapshot(own).colors) count += color >> 24 != 0;
        return count;
    };
    EXPECT_GT(colored(40.0f), 200);
    EXPECT_EQ(colored(70.0f), 0);
}

TEST_F(ColorIntegrationTest, SnapshotsCarryColorsAndOnlySurfaceBricksHaveThem) {
    fuse(
        wall, [](const auto&) { return red; }, at(0.32f, -0.1f));
    const VolumeSnapshot snapshot = take_snapshot(volume);
    ASSERT_FALSE(snapshot.color_bricks.empty());
    EXPECT_LE(snapshot.color_bricks.size(), 128u) << "the layers of bricks on both sides of z = 0.4";
    EXPECT_LT(snapshot.color_bricks.size(), snapshot.bricks.size());
    const TsdfVolume restored = restore_volume(device, snapshot);
    const VolumeSnapshot again = take_snapshot(restored);
    EXPECT_EQ(again.bricks, snapshot.bricks);
    EXPECT_EQ(again.voxels, snapshot.voxels);
    EXPECT_EQ(again.color_bricks, snapshot.color_bricks);
    EXPECT_EQ(again.colors, snapshot.colors);
    const TsdfVolume plain(device, test::small_volume());
    EXPECT_GT(volume.memory_bytes(), plain.memory_bytes());
    EXPECT_EQ(plain.colors(), nullptr);
}

TEST_F(ColorIntegrationTest, ColorsThatDoNotFitAreRefused) {
    fuse(
        wall, [](const auto&) { return red; }, at(0.32f, -0.1f));
    VolumeSnapshot snapshot = take_snapshot(volume);
    snapshot.colors.pop_back();
    EXPECT_THROW((void)restore_volume(device, snapshot), Error);
    snapshot = take_snapshot(volume);
    snapshot.bricks.erase(std::ranges::find(snapshot.bricks, snapshot.color_bricks.front()));
    snapshot.voxels.resize(snapshot.bricks.size() * BRICK_VOXELS);
    EXPECT_THROW((void)restore_volume(device, snapshot), Error);
    const std::vector<std::uint8_t> small(300);
    const std::vector<int> bricks{0};
    EXPECT_THROW(coloring.integrate(volume, live, small, weighting.weigh(live), at(0.32f, -0.1f), bricks),
                 Error);
}

}  // namespace
}  // namespace touchstone
