#include "tests/reference/listing_2.hpp"

#include <gtest/gtest.h>

#include "pipeline/volumetric_integration.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"
#include "tests/support/small_volume.hpp"

namespace touchstone {
namespace {

using test::pose_in_front;
using test::small_volume;

struct Scene {
    Intrinsics k = test::small_camera();
    MapShape shape = make_map_shape(k);
    std::vector<float> depth_m =
        test::render_depth_m(k, test::both(test::plane(Eigen::Vector3f(0.2f, 0.4f, 1.0f).normalized(), 0.7f),
                                           test::sphere({0.0f, 0.0f, 0.6f}, 0.1f)));
    std::vector<std::uint8_t> weights = std::vector<std::uint8_t>(depth_m.size(), 1);
};

struct Compared {
    int differing = 0, known = 0, missing_near_surface = 0;
};

/// Every voxel of the cube against the dense reference: TSDF within 3 of 32766 steps and equal weight; free
/// space may have been seen less often, before there was a brick.
Compared compare(const TsdfVolume& volume, reference::DenseVolume& dense) {
    Compared result;
    const std::vector<int> pool = volume.pool().read();
    const int n = volume.params().size_vox, side = volume.params().bricks_per_side;
    for (int z = 0; z < n; ++z) {
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                const reference::Voxel expected = dense.at(x, y, z);
                const int slot = volume.slot(((z / 8) * side + y / 8) * side + x / 8);
                if (slot < 0) {
                    result.missing_near_surface += expected.weight > 0 && expected.tsdf < 1.0f;
                    continue;
                }
                const auto at =
                    static_cast<std::size_t>(slot * BRICK_VOXELS + ((z & 7) * 8 + (y & 7)) * 8 + (x & 7));
                const int packed = pool[at];
                const float tsdf =
                    static_cast<float>(static_cast<std::int16_t>(packed & 0xffff)) / TSDF_SCALE;
                const int weight = packed >> 16 & 0xff;
                result.known += weight > 0;
                const bool missed_free_space = expected.tsdf == 1.0f && weight < expected.weight;
                const bool same = missed_free_space ||
                                  (weight == expected.weight &&
                                   (weight == 0 || std::abs(tsdf - expected.tsdf) < 3.0f / TSDF_SCALE));
                result.differing += !same;
            }
        }
    }
    return result;
}

TEST(Listing2, AgreesWithTheDenseReferenceOverSeveralFrames) {
    const Device device(DeviceConfig{});
    Scene scene;
    for (std::size_t hole = 0; hole < scene.depth_m.size(); hole += 13) scene.depth_m[hole] = 0.0f;
    for (std::size_t pixel = 0; pixel < scene.weights.size(); ++pixel)
        scene.weights[pixel] = static_cast<std::uint8_t>(pixel < 600 ? 0 : 1 + pixel / 1000 % 8);
    const Buffer<float> depth(device, test::padded<float>(scene.shape, scene.depth_m));
    const Buffer<std::uint8_t> weights(device, test::padded<std::uint8_t>(scene.shape, scene.weights));
    TsdfVolume volume(device, small_volume(20));
    reference::DenseVolume dense(volume.params());
    VolumetricIntegration integration(device, scene.k);
    for (int frame = 0; frame < 5; ++frame) {
        const RigidTransform T_g_c =
            pose_in_front() * Eigen::Translation3f(0.004f * static_cast<float>(frame), 0.0f, 0.0f);
        integration.integrate(volume, depth, weights, T_g_c, all_layers(volume));
        reference::integrate(dense, scene.depth_m, scene.weights, scene.k, T_g_c);
    }
    const Compared result = compare(volume, dense);
    EXPECT_GT(result.known, 20000);
    // A voxel that projects on the border of two pixels may round to either.
    EXPECT_LT(result.differing, result.known / 50);
    EXPECT_EQ(result.missing_near_surface, 0);
}

TEST(Listing2, OneFrameEqualsTheReferenceInEveryBrick) {
    const Device device(DeviceConfig{});
    Scene scene;
    for (int y = 30; y < 40; ++y)  // left out in the middle
        for (int x = 40; x < 55; ++x) scene.weights[static_cast<std::size_t>(y * scene.k.width_px + x)] = 0;
    TsdfVolume volume(device, small_volume(3));
    reference::DenseVolume dense(volume.params());
    VolumetricIntegration integration(device, scene.k);
    const Buffer<float> depth(device, test::padded<float>(scene.shape, scene.depth_m));
    const Buffer<std::uint8_t> weights(device, test::padded<std::uint8_t>(scene.shape, scene.weights));
    integration.integrate(volume, depth, weights, pose_in_front(), all_layers(volume));
    reference::integrate(dense, scene.depth_m, scene.weights, scene.k, pose_in_front());
    const Compared result = compare(volume, dense);
    EXPECT_LE(result.differing, result.known / 1000);
    EXPECT_EQ(result.missing_near_surface, 0);
    EXPECT_LT(volume.bricks_in_use(), 512 * 3 / 4)
        << "the cube is small: a band of 10 of its 64 voxels, but not all of it";
}

TEST(Listing2, PixelsWithoutWeightOrDepthChangeNothing) {
    const Device device(DeviceConfig{});
    const Scene scene;
    TsdfVolume volume(device, small_volume(3));
    VolumetricIntegration integration(device, scene.k);
    const Buffer<float> depth(device, test::padded<float>(scene.shape, scene.depth_m));
    Buffer<std::uint8_t> weights(device, map_pixels(scene.shape));
    weights.fill(0);
    integration.integrate(volume, depth, weights, pose_in_front(), all_layers(volume));
    EXPECT_EQ(volume.bricks_in_use(), 0);
    weights.fill(8);
    Buffer<float> nothing(device, map_pixels(scene.shape));
    nothing.fill(0.0f);
    TsdfVolume empty(device, small_volume(3));
    EXPECT_TRUE(integration.integrate(empty, nothing, weights, pose_in_front(), all_layers(empty)).empty());
    EXPECT_EQ(empty.bricks_in_use(), 0);
}

void expect_equal(const TsdfVolume& whole, const TsdfVolume& parts) {
    ASSERT_EQ(whole.bricks_in_use(), parts.bricks_in_use());
    const std::vector<int> a = whole.pool().read(), b = parts.pool().read();
    for (std::size_t brick = 0; brick < whole.brick_count(); ++brick) {
        const int i = whole.slot(static_cast<int>(brick)), j = parts.slot(static_cast<int>(brick));
        ASSERT_EQ(i >= 0, j >= 0);
        if (i < 0) continue;
        const auto first = a.begin() + static_cast<std::ptrdiff_t>(i) * BRICK_VOXELS;
        ASSERT_TRUE(std::equal(first, first + BRICK_VOXELS,
                               b.begin() + static_cast<std::ptrdiff_t>(j) * BRICK_VOXELS));
    }
}

TEST(Listing2, SlicesTogetherEqualTheWhole) {
    const Device device(DeviceConfig{});
    const Scene scene;
    const Buffer<float> depth(device, test::padded<float>(scene.shape, scene.depth_m));
    const Buffer<std::uint8_t> weights(device, test::padded<std::uint8_t>(scene.shape, scene.weights));
    TsdfVolume whole(device, small_volume(3)), sliced(device, small_volume(3));
    VolumetricIntegration integration(device, scene.k);
    integration.integrate(whole, depth, weights, pose_in_front(), all_layers(whole));
    for (int part = 0; part < 3; ++part) {
        integration.integrate(sliced, depth, weights, pose_in_front(), layer_share(sliced, part, 3));
    }
    expect_equal(whole, sliced);
}

TEST(Listing2, InterleavedLayersTogetherEqualTheWhole) {
    const Device device(DeviceConfig{});
    const Scene scene;
    const Buffer<float> depth(device, test::padded<float>(scene.shape, scene.depth_m));
    const Buffer<std::uint8_t> weights(device, test::padded<std::uint8_t>(scene.shape, scene.weights));
    TsdfVolume whole(device, small_volume(3)), parts(device, small_volume(3));
    VolumetricIntegration integration(device, scene.k);
    integration.integrate(whole, depth, weights, pose_in_front(), all_layers(whole));
    const int side = whole.params().bricks_per_side;
    for (int part = 0; part < 3; ++part) {
        const std::vector<int>& bricks =
            integration.integrate(parts, depth, weights, pose_in_front(), interleaved_layers(parts, part, 3));
        ASSERT_FALSE(bricks.empty());
        for (const int brick : bricks) EXPECT_EQ(brick / side % side % 3, part);
    }
    expect_equal(whole, parts);
}

int known_weight(const TsdfVolume& volume) {
    int sum = 0;
    for (const int voxel : volume.pool().read()) sum += voxel >> 16 & 0xff;
    return sum;
}

/// A patch on the border of two tiles, half of it in each, before a far wall: how many bricks it makes.
int bricks_of_a_patch(int pixels_per_tile) {
    const Device device(DeviceConfig{});
    const Intrinsics k = test::small_camera(240, 200);
    const MapShape shape = make_map_shape(k);
    std::vector<float> depth_m(static_cast<std::size_t>(k.width_px * k.height_px), 2.0f);
    const int border = 6 * TILE_PX;
    for (int x = 100; x < 100 + pixels_per_tile; ++x) {
        for (const int y : {border - 1, border}) depth_m[static_cast<std::size_t>(y * k.width_px + x)] = 0.7f;
    }
    TsdfVolume volume(device, small_volume());
    VolumetricIntegration integration(device, k);
    const std::vector<std::uint8_t> weights(depth_m.size(), 1);
    integration.integrate(volume, Buffer<float>(device, test::padded<float>(shape, depth_m)),
                          Buffer<std::uint8_t>(device, test::padded<std::uint8_t>(shape, weights)),
                          pose_in_front(), all_layers(volume));
    return volume.bricks_in_use();
}

TEST(Listing2, FewPixelsThatFlyMakeNoBrickAndThoseOfAllTilesCount) {
    EXPECT_EQ(bricks_of_a_patch(BRICK_EDGE_PIXELS / 2 - 1), 0);
    EXPECT_GT(bricks_of_a_patch(BRICK_EDGE_PIXELS / 2 + 1), 0);
}

TEST(Listing2, PoolLimitIsSaidOnceAndWhatIsKeptGoesOn) {
    const Device device(DeviceConfig{});
    const Scene scene;
    const Buffer<float> depth(device, test::padded<float>(scene.shape, scene.depth_m));
    const Buffer<std::uint8_t> weights(device, test::padded<std::uint8_t>(scene.shape, scene.weights));
    VolumeConfig config = small_volume(128);
    config.max_bricks = 20;
    TsdfVolume volume(device, config);
    VolumetricIntegration integration(device, scene.k);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    integration.integrate(volume, depth, weights, pose_in_front(), all_layers(volume));
    const int once = known_weight(volume);
    EXPECT_GT(once, 0);
    integration.integrate(volume, depth, weights, pose_in_front(), all_layers(volume));
    EXPECT_EQ(known_weight(volume), 2 * once) << "bricks in use are kept up";
    const std::string said = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("volume full: 20 bricks"), std::string::npos) << said;
    EXPECT_EQ(said.find("volume full"), said.rfind("volume full"));
    EXPECT_EQ(volume.bricks_in_use(), 20);
    EXPECT_TRUE(volume.is_full());
}

}  // namespace
}  // namespace touchstone
