#include "tests/reference/listing_3.hpp"

#include <gtest/gtest.h>

#include "pipeline/raycasting.hpp"
#include "pipeline/volumetric_integration.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"
#include "tests/support/small_volume.hpp"

namespace touchstone {
namespace {

using test::pose_in_front;
using test::small_volume;

class Listing3 : public testing::Test {
  protected:
    void fuse(const std::vector<float>& picture_m, const RigidTransform& T_g_c) {
        const Buffer<float> depth(device, test::padded<float>(shape, picture_m));
        const std::vector<int>& changed =
            integration.integrate(volume, depth, weights, T_g_c, all_layers(volume));
        changed_bricks.assign(changed.begin(), changed.end());
        reference::integrate(dense, picture_m, std::vector<std::uint8_t>(picture_m.size(), 1), k, T_g_c);
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(240, 200);  // pixels a third of a voxel wide, as in practice
    MapShape shape = make_map_shape(k);
    test::DepthOfRay surface = test::both(test::plane(Eigen::Vector3f(0.2f, 0.4f, 1.0f).normalized(), 0.7f),
                                          test::sphere({0.0f, 0.0f, 0.6f}, 0.1f));
    std::vector<float> depth_m = test::render_depth_m(k, surface);
    Buffer<std::uint8_t> weights = [&] {
        Buffer<std::uint8_t> map(device, map_pixels(shape));
        map.fill(1);
        return map;
    }();
    TsdfVolume volume{device, small_volume()};
    reference::DenseVolume dense{volume.params()};
    VolumetricIntegration integration{device, k};
    Raycasting raycasting{device, k};
    SurfacePrediction prediction{device, shape};
    std::vector<int> changed_bricks;
};

TEST_F(Listing3, AgreesWithTheReferenceRaycast) {
    fuse(depth_m, pose_in_front());
    raycasting.raycast(volume, pose_in_front(), prediction);
    const std::vector<float> predicted_m = test::cropped(shape, prediction.depth_m.read());
    int hits = 0, off = 0;
    for (int y = 0; y < k.height_px; y += 3) {
        for (int x = 0; x < k.width_px; x += 3) {
            const float expected = reference::raycast(dense, pose_in_front(), test::pixel_ray(k, x, y), 1.5f);
            const float got = predicted_m[static_cast<std::size_t>(y * k.width_px + x)];
            hits += expected > 0.0f;
            off += std::abs(got - expected) > 0.1f * volume.params().voxel_m;
        }
    }
    EXPECT_GT(hits, 3500);
    // Steps of a voxel jump over what a quarter-voxel walk sees at silhouettes: at most 2 % of the pixels.
    EXPECT_LT(off, hits / 50);
}

TEST_F(Listing3, FindsTheAnalyticSurfaceAndItsNormals) {
    for (int frame = 0; frame < 3; ++frame) fuse(depth_m, pose_in_front());
    raycasting.raycast(volume, pose_in_front(), prediction);
    const std::vector<float> predicted_m = test::cropped(shape, prediction.depth_m.read());
    const std::vector<float> normals = prediction.normals_c.read();
    const Eigen::Vector3f n = -Eigen::Vector3f(0.2f, 0.4f, 1.0f).normalized();
    int hits = 0, off = 0, leaning = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto pixel = static_cast<std::size_t>(y * k.width_px + x);
            const Eigen::Vector3f ray = test::pixel_ray(k, x, y);
            const bool on_plane = depth_m[pixel] == test::plane(-n, 0.7f)(ray);
            if (predicted_m[pixel] <= 0.0f || !on_plane) continue;
            ++hits;
            off += std::abs(predicted_m[pixel] - depth_m[pixel]) > 0.25f * volume.params().voxel_m;
            Eigen::Vector3f got;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                got[static_cast<int>(axis)] = normals[axis * map_pixels(shape) + map_index(shape, x, y)];
            }
            leaning += got.dot(n) < std::cos(0.17f);
        }
    }
    EXPECT_GT(hits, 20000);
    EXPECT_LT(off, hits / 33) << "more than a quarter voxel off, outside silhouettes";
    EXPECT_LT(leaning, hits / 20) << "normals more than 10 degrees off";
}

TEST_F(Listing3, UnknownNeverMakesASurface) {
    raycasting.raycast(volume, pose_in_front(), prediction);
    EXPECT_EQ(prediction.depth_m.read(), std::vector<float>(map_pixels(shape), 0.0f));
    // From behind, the scanned surface shows its back: there is nothing to see.
    fuse(depth_m, pose_in_front());
    RigidTransform behind = RigidTransform::Identity();
    behind.translate(Eigen::Vector3f(0.32f, 0.32f, 1.1f));
    behind.rotate(Eigen::AngleAxisf(3.14159f, Eigen::Vector3f::UnitY()));
    raycasting.raycast(volume, behind, prediction);
    EXPECT_EQ(prediction.depth_m.read(), std::vector<float>(map_pixels(shape), 0.0f));
}

TEST_F(Listing3, RefreshedTilesEqualAFullRaycast) {
    fuse(depth_m, pose_in_front());
    SurfacePrediction cached(device, shape);
    raycasting.raycast(volume, pose_in_front(), cached);
    std::vector<float> moved_m = depth_m;
    for (float& z : moved_m) z -= 0.004f;
    const Buffer<float> depth(device, test::padded<float>(shape, moved_m));
    for (int part = 0; part < 4; ++part) {
        const std::vector<int>& changed =
            integration.integrate(volume, depth, weights, pose_in_front(), layer_share(volume, part, 4));
        raycasting.refresh(volume, pose_in_front(), changed, cached);
        raycasting.raycast(volume, pose_in_front(), prediction);
        ASSERT_EQ(cached.depth_m.read(), prediction.depth_m.read()) << "part " << part;
        ASSERT_EQ(cached.normals_c.read(), prediction.normals_c.read()) << "part " << part;
    }
}

TEST_F(Listing3, CameraInsideTheVolumeSeesTheSurface) {
    RigidTransform inside = RigidTransform::Identity();
    inside.translate(Eigen::Vector3f(0.32f, 0.32f, 0.1f));
    const std::vector<float> wall_m(depth_m.size(), 0.4f);
    fuse(wall_m, inside);
    raycasting.raycast(volume, inside, prediction);
    const std::vector<float> predicted_m = test::cropped(shape, prediction.depth_m.read());
    int hits = 0;
    for (const float z : predicted_m) {
        if (z <= 0.0f) continue;
        ++hits;
        ASSERT_NEAR(z, 0.4f, 0.1f * volume.params().voxel_m);
    }
    EXPECT_GT(hits, static_cast<int>(predicted_m.size() * 8 / 10));
}

}  // namespace
}  // namespace touchstone
