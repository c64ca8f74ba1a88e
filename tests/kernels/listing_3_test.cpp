#include "tests/reference/listing_3.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <optional>

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

TEST_F(Listing3, EveryBrickOfAListRefreshesItsTiles) {
    fuse(depth_m, pose_in_front());
    const auto refreshed = [&](std::span<const int> bricks) {
        prediction.depth_m.fill(9.0f);
        raycasting.refresh(volume, pose_in_front(), bricks, prediction);
        std::vector<bool> done;
        for (const float z : prediction.depth_m.read()) done.push_back(z != 9.0f);
        return done;
    };
    std::vector<int> list;
    for (std::size_t i = 0; i < 9; ++i) list.push_back(changed_bricks[i * changed_bricks.size() / 9]);
    std::vector<bool> one_by_one(map_pixels(shape), false);
    for (const int brick : list) {
        const std::vector<bool> done = refreshed(std::span(&brick, 1));
        for (std::size_t i = 0; i < done.size(); ++i) one_by_one[i] = one_by_one[i] || done[i];
    }
    EXPECT_GT(std::ranges::count(one_by_one, true), 0);
    EXPECT_GT(std::ranges::count(one_by_one, false), 0);
    EXPECT_EQ(refreshed(list), one_by_one);
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

/// A cube of layers along z that a test writes: `tsdf_of_layer` gives nothing where voxels are unknown.
template <class TsdfOfLayer>
void write_layers(TsdfVolume& volume, TsdfOfLayer&& tsdf_of_layer) {
    std::vector<int> bricks(volume.brick_count());
    std::iota(bricks.begin(), bricks.end(), 0);
    volume.allocate(bricks);
    std::vector<std::int32_t> voxels(bricks.size() * BRICK_VOXELS, 0);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const int layer =
            static_cast<int>(i / BRICK_VOXELS) / 64 * 8 + static_cast<int>(i % BRICK_VOXELS) / 64;
        const std::optional<float> tsdf = tsdf_of_layer(layer);
        if (!tsdf) continue;
        voxels[i] = (static_cast<int>(*tsdf * TSDF_SCALE) & 0xffff) | 5 << 16;
    }
    volume.write(voxels);
}

class LayersTest : public Listing3 {
  protected:
    /// What a camera at z_m looking along z sees in the middle.
    float middle_m(float z_m = -0.2f) {
        RigidTransform T_g_c = RigidTransform::Identity();
        T_g_c.translation() = Eigen::Vector3f(0.32f, 0.32f, z_m);
        raycasting.raycast(volume, T_g_c, prediction);
        return prediction.depth_m.read()[map_index(shape, k.width_px / 2, k.height_px / 2)];
    }
};

TEST_F(LayersTest, FromKnownSpaceIntoASlabIsASurface) {
    write_layers(volume, [](int layer) { return std::optional(layer < 30 ? 0.1f : -0.1f); });
    EXPECT_NEAR(middle_m(), 0.5f, 0.001f);
}

TEST_F(LayersTest, FromUnknownSpaceIntoASlabIsNone) {
    write_layers(volume, [](int layer) { return layer < 30 ? std::nullopt : std::optional(-0.1f); });
    EXPECT_EQ(middle_m(), 0.0f);
    // Nor is one where known space ends before the slab begins.
    write_layers(volume, [](int layer) {
        if (layer < 20) return std::optional(0.5f);
        return layer < 30 ? std::nullopt : std::optional(-0.1f);
    });
    EXPECT_EQ(middle_m(), 0.0f);
}

TEST_F(LayersTest, CameraInsideASlabSeesNothingOfIt) {
    write_layers(volume,
                 [](int layer) { return std::optional(-0.01f - 0.0005f * static_cast<float>(layer)); });
    EXPECT_EQ(middle_m(0.2f), 0.0f);
}

TEST_F(LayersTest, ComingOutOfTheBackOfASlabEndsTheRay) {
    // Unknown, inside, out through its back, and then the front of another: hidden by the first.
    write_layers(volume, [](int layer) {
        if (layer < 10) return std::optional<float>();
        return std::optional(layer < 20 || layer >= 30 ? -0.1f : 0.1f);
    });
    EXPECT_EQ(middle_m(), 0.0f);
}

TEST_F(LayersTest, NormalsFaceTheCamera) {
    fuse(depth_m, pose_in_front());
    raycasting.raycast(volume, pose_in_front(), prediction);
    const std::vector<float> normals = prediction.normals_c.read(), seen = prediction.depth_m.read();
    int hits = 0, averted = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const std::size_t at = map_index(shape, x, y), plane = map_pixels(shape);
            if (seen[at] <= 0.0f) continue;
            const Eigen::Vector3f n(normals[at], normals[plane + at], normals[2 * plane + at]);
            ASSERT_NEAR(n.norm(), 1.0f, 1e-3f);
            ++hits;
            averted += n.dot(test::pixel_ray(k, x, y)) >= 0.0f;
        }
    }
    EXPECT_GT(hits, 20000);
    EXPECT_EQ(averted, 0);
}

}  // namespace
}  // namespace touchstone
