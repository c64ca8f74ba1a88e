#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "tests/support/fusion_chain.hpp"
#include "tests/support/global_scene.hpp"
#include "tests/support/small_volume.hpp"

/// Where a fused surface lies, without noise: 64^3 voxels of 10 mm.
namespace touchstone {
namespace {

using test::FusionChain;
using test::small_volume;

/// Corners are 38 degrees off axis, where a ray is 1.27 times as long as its depth.
Intrinsics wide_camera() { return {200.0f, 200.0f, 119.5f, 99.5f, 240, 200, {0, 0}}; }

RigidTransform at(float x_m, float y_m, float z_m) {
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.translation() = Eigen::Vector3f(x_m, y_m, z_m);
    return T_g_c;
}

/// The plane z = z_m of the global frame, turned by `tilt_rad` about the axis through (x_m, z_m) along y.
test::Surface wall(float x_m, float z_m, float tilt_rad = 0.0f) {
    return [=](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
        const Eigen::Vector3f n(std::sin(tilt_rad), 0.0f, std::cos(tilt_rad)), p(x_m, 0.0f, z_m);
        const float t = n.dot(p - origin) / n.dot(direction);
        return std::isfinite(t) && t > 0.0f ? t : 0.0f;
    };
}

struct Offsets {
    int expected = 0, seen = 0;
    float mean_vox = 0.0f, worst_vox = 0.0f;
};

/// Along z, of the pixels 8 px from the picture's border whose surface is `margin_m` inside the cube.
Offsets compare(FusionChain& chain, const test::Surface& scene, const RigidTransform& T_g_c,
                float margin_m = 0.03f) {
    const std::vector<float> truth = test::view_m(chain.k, scene, T_g_c), seen = chain.seen_m(T_g_c);
    const float voxel_m = chain.volume.params().voxel_m, side_m = chain.volume.config().side_m;
    Offsets offsets;
    for (int y = 8; y < chain.k.height_px - 8; ++y) {
        for (int x = 8; x < chain.k.width_px - 8; ++x) {
            const auto pixel = static_cast<std::size_t>(y * chain.k.width_px + x);
            const Eigen::Vector3f p_g = T_g_c * (truth[pixel] * test::pixel_ray(chain.k, x, y));
            if (truth[pixel] <= 0.0f || p_g.minCoeff() < margin_m || p_g.maxCoeff() > side_m - margin_m)
                continue;
            ++offsets.expected;
            if (seen[pixel] <= 0.0f) continue;
            ++offsets.seen;
            const float off_vox = (seen[pixel] - truth[pixel]) / voxel_m;
            offsets.mean_vox += off_vox;
            offsets.worst_vox = std::max(offsets.worst_vox, std::abs(off_vox));
        }
    }
    offsets.mean_vox /= static_cast<float>(std::max(1, offsets.seen));
    return offsets;
}

/// Ray length and depth, mixed up, would bow it by voxels.
TEST(SurfaceGeometry, WallComesBackFlatToTheCorners) {
    FusionChain chain(wide_camera(), small_volume());
    const test::Surface scene = wall(0.32f, 0.3f);
    const RigidTransform T_g_c = at(0.32f, 0.32f, -0.1f);
    for (int i = 0; i < 3; ++i) chain.fuse(test::to_mm(test::view_m(chain.k, scene, T_g_c)), T_g_c);
    const Offsets offsets = compare(chain, scene, T_g_c);
    EXPECT_GT(offsets.expected, 30000);
    EXPECT_EQ(offsets.seen, offsets.expected);
    EXPECT_LT(offsets.worst_vox, 0.1f);
}

/// A pixel rounded down instead of to the nearest moves a wall at 45 degrees by half a pixel: 1 mm.
TEST(SurfaceGeometry, SlantedWallsAreBiasedToNeitherSide) {
    for (const float tilt_rad : {-0.785f, 0.785f}) {
        FusionChain chain(wide_camera(), small_volume());
        const test::Surface scene = wall(0.32f, 0.3f, tilt_rad);
        const RigidTransform T_g_c = at(0.32f, 0.32f, -0.35f);
        for (int i = 0; i < 3; ++i) chain.fuse(test::to_mm(test::view_m(chain.k, scene, T_g_c)), T_g_c);
        const Offsets offsets = compare(chain, scene, T_g_c);
        EXPECT_GT(offsets.seen, offsets.expected * 99 / 100);
        EXPECT_LT(std::abs(offsets.mean_vox), 0.03f) << tilt_rad;
    }
}

/// Steps of most of the truncation would jump over it.
TEST(SurfaceGeometry, FlatlySeenWallsAreHitEverywhere) {
    FusionChain chain(wide_camera(), small_volume(), {.max_angle_deg = 90.0f});
    const test::Surface scene = wall(0.32f, 0.32f, 1.1f);
    const RigidTransform T_g_c = at(0.32f, 0.32f, -0.35f);
    for (int i = 0; i < 3; ++i) chain.fuse(test::to_mm(test::view_m(chain.k, scene, T_g_c)), T_g_c);
    const Offsets offsets = compare(chain, scene, T_g_c, 0.06f);
    EXPECT_GT(offsets.expected, 5000);
    EXPECT_GT(offsets.seen, offsets.expected * 99 / 100);
}

TEST(SurfaceGeometry, NothingIsKnownBehindTheCameraOrFarBehindTheSurface) {
    FusionChain chain(wide_camera(), small_volume());
    const RigidTransform T_g_c = at(0.32f, 0.32f, 0.32f);
    // Allocates every brick, so that none is unknown for want of a slot.
    std::vector<int> all(chain.volume.brick_count());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    chain.volume.allocate(all);
    const std::vector<std::uint16_t> wall_mm(static_cast<std::size_t>(240 * 200), 200);
    DepthMapConversionConfig near;
    near.min_depth_m = 0.1f;
    LiveMaps live(chain.device, make_map_shape(chain.k));
    DepthMapConversion(chain.device, near, chain.k).convert({wall_mm, chain.k}, live);
    SampleWeighting weighting(chain.device, {}, chain.k);
    VolumetricIntegration(chain.device, chain.k)
        .integrate(chain.volume, live.depth_m, weighting.weigh(live), T_g_c, all_layers(chain.volume));
    const std::vector<int> pool = chain.volume.pool().read();
    int known_before_the_wall = 0;
    for (int slot = 0; slot < chain.volume.bricks_in_use(); ++slot) {
        for (int voxel = 0; voxel < BRICK_VOXELS; ++voxel) {
            const auto packed = pool[static_cast<std::size_t>(slot * BRICK_VOXELS + voxel)];
            if ((packed >> 16 & 0xff) == 0) continue;
            const int z = slot / 64 * 8 + voxel / 64;  // 8 bricks a side, in order
            ASSERT_GE(z, 37) << "behind the camera, or nearer than 5 cm";
            ASSERT_LE(z, 55) << "more than the truncation of 40 mm behind the wall at z = 52";
            known_before_the_wall += z < 52;
        }
    }
    EXPECT_GT(known_before_the_wall, 1000);
}

/// Bricks come from projecting boxes, not from rays, which leave holes between far bricks.
TEST(SurfaceGeometry, FarWallHasNoHoles) {
    VolumeConfig config;
    config.size_vox = 256;
    config.side_m = 1.5f;
    const Intrinsics k{80.0f, 80.0f, 39.5f, 29.5f, 80, 60, {0, 0}};  // pixels of 44 mm there, bricks of 47 mm
    FusionChain chain(k, config);
    const RigidTransform T_g_c = at(0.75f, 0.75f, -2.8f);
    const test::Surface scene = wall(0.75f, 0.7f);
    chain.fuse(test::to_mm(test::view_m(k, scene, T_g_c)), T_g_c);
    const Offsets offsets = compare(chain, scene, T_g_c, 0.08f);
    EXPECT_GT(offsets.expected, 500);
    EXPECT_EQ(offsets.seen, offsets.expected);
}

TEST(SurfaceGeometry, HolesOfOnePixelEverywhereLeaveAWall) {
    FusionChain chain(wide_camera(), small_volume());
    const test::Surface scene = wall(0.32f, 0.3f);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> shift_m(-0.01f, 0.01f);
    for (int frame = 0; frame < 10; ++frame) {
        const RigidTransform T_g_c = at(0.32f + shift_m(random), 0.32f + shift_m(random), -0.1f);
        std::vector<std::uint16_t> depth_mm = test::to_mm(test::view_m(chain.k, scene, T_g_c));
        for (int y = 0; y < 200; ++y) {
            for (int x = (y + frame) % 2; x < 240; x += 2)
                depth_mm[static_cast<std::size_t>(y * 240 + x)] = 0;
        }
        chain.fuse(depth_mm, T_g_c);
    }
    const Offsets offsets = compare(chain, scene, at(0.32f, 0.32f, -0.1f));
    EXPECT_GT(offsets.seen, offsets.expected * 999 / 1000);
    EXPECT_LT(offsets.worst_vox, 0.25f);
}

/// Between a thing and the wall behind it there is nothing, although the filter and interpolation could make
/// it.
TEST(SurfaceGeometry, NoSkinAlongASilhouette) {
    FusionChain chain(wide_camera(), small_volume());
    const test::Surface scene =
        test::nearest({test::box({0.22f, 0.22f, 0.15f}, {0.42f, 0.42f, 0.17f}), wall(0.32f, 0.5f)});
    const RigidTransform T_g_c = at(0.32f, 0.32f, -0.25f);
    for (int i = 0; i < 10; ++i) chain.fuse(test::to_mm(test::view_m(chain.k, scene, T_g_c)), T_g_c);
    // From 30 degrees aside the gap is open to view.
    RigidTransform aside = at(0.72f, 0.32f, -0.2f);
    aside.rotate(Eigen::AngleAxisf(-0.6f, Eigen::Vector3f::UnitY()));
    const std::vector<float> seen = chain.seen_m(aside);
    int thing = 0, wall_behind = 0;
    for (int y = 0; y < chain.k.height_px; ++y) {
        for (int x = 0; x < chain.k.width_px; ++x) {
            const float z_m = seen[static_cast<std::size_t>(y * chain.k.width_px + x)];
            if (z_m <= 0.0f) continue;
            const Eigen::Vector3f p_g = aside * (z_m * test::pixel_ray(chain.k, x, y));
            const bool on_thing = p_g.z() < 0.20f, on_wall = std::abs(p_g.z() - 0.5f) < 0.015f;
            thing += on_thing;
            wall_behind += on_wall;
            ASSERT_TRUE(on_thing || on_wall) << "at z = " << p_g.z();
        }
    }
    EXPECT_GT(thing, 1000);
    EXPECT_GT(wall_behind, 1000);
}

/// Rounding toward zero would draw averages by up to 64 steps of 1/32766 toward the surface.
TEST(SurfaceGeometry, AverageOfManyFramesIsTheirMean) {
    FusionChain chain(wide_camera(), small_volume(), {.most = 1});
    const RigidTransform T_g_c = at(0.32f, 0.32f, -0.1f);
    const auto picture_mm = [](std::uint16_t mm) { return std::vector<std::uint16_t>(240 * 200, mm); };
    chain.fuse(picture_mm(400), T_g_c);
    const std::vector<int> mean = chain.volume.pool().read();
    for (int i = 0; i < 200; ++i) {
        chain.fuse(picture_mm(398), T_g_c);
        chain.fuse(picture_mm(402), T_g_c);
    }
    const std::vector<int> often = chain.volume.pool().read();
    ASSERT_GE(often.size(), mean.size());
    double off_steps = 0.0;
    int compared = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const int value = static_cast<std::int16_t>(mean[i]);
        if ((mean[i] >> 16 & 0xff) == 0 || value < 2000 || value > 28000) continue;
        ++compared;
        off_steps += static_cast<std::int16_t>(often[i]) - value;
        ASSERT_EQ(often[i] >> 16 & 0xff, 128);
    }
    EXPECT_GT(compared, 5000);
    EXPECT_LT(std::abs(off_steps / compared), 12.0);
}

}  // namespace
}  // namespace touchstone
