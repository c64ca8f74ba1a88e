#include "tests/benchmarks/dense_yardstick.hpp"

#include <gtest/gtest.h>

#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

constexpr int size_vox = 64;
constexpr float side_m = 1.0f, voxel_m = side_m / size_vox, truncation_m = 0.06f;

/// A camera before the cube that looks into it; a slanted wall with a hole.
class DenseYardstick : public testing::Test {
  protected:
    DenseYardstick() {
        for (int y = 0; y < k.height_px; ++y)
            for (int x = 0; x < k.width_px; ++x) depth_m.push_back(x == 50 && y == 40 ? 0.0f : wall_m(x, y));
        live = Buffer<float>(device, test::padded<float>(shape, depth_m));
    }
    /// z of the plane z = 0.95 + 0.3 x on a pixel's ray.
    float wall_m(int x, int) const {
        return 0.95f / (1.0f - 0.3f * (static_cast<float>(x) - k.cx_px) / k.fx_px);
    }
    /// Listing 2 for one voxel, in plain C++: TSDF and weight.
    std::pair<float, int> expected(int x, int y, int z) const {
        const Eigen::Vector3f p_g =
            voxel_m * Eigen::Vector3f(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                                      static_cast<float>(z) + 0.5f);
        const Eigen::Vector3f p = T_g_c.inverse() * p_g;
        const int u = static_cast<int>(std::floor(p.x() / p.z() * k.fx_px + k.cx_px + 0.5f));
        const int v = static_cast<int>(std::floor(p.y() / p.z() * k.fy_px + k.cy_px + 0.5f));
        if (u < 0 || v < 0 || u >= k.width_px || v >= k.height_px) return {0.0f, 0};
        const float depth = depth_m[static_cast<std::size_t>(v * k.width_px + u)], sdf = depth - p.z();
        if (depth <= 0.0f || sdf <= -truncation_m) return {0.0f, 0};
        return {std::min(1.0f, sdf / truncation_m), 1};
    }

    Intrinsics k{110.0f, 110.0f, 79.5f, 59.5f, 160, 120, {0, 0}};
    MapShape shape = make_map_shape(k);
    Device device{DeviceConfig{}};
    RigidTransform T_g_c = RigidTransform(Eigen::Translation3f(0.5f, 0.5f, -0.45f));
    std::vector<float> depth_m;
    Buffer<float> live;
    DenseVolume volume{device, k, size_vox, side_m, truncation_m};
};

/// Equal to a step of the voxel's TSDF but for one voxel in a thousand, on a pixel's border.
TEST_F(DenseYardstick, SweepsLikeTheListing) {
    volume.integrate(live, T_g_c);
    const std::vector<int> voxels = volume.voxels().read();
    int differing = 0, known = 0;
    for (int i = 0; i < size_vox * size_vox * size_vox; ++i) {
        const auto [tsdf, weight] = expected(i % size_vox, i / size_vox % size_vox, i / size_vox / size_vox);
        const int voxel = voxels[static_cast<std::size_t>(i)];
        const float found = static_cast<float>(static_cast<std::int16_t>(voxel & 0xffff)) / 32766.0f;
        known += weight;
        differing += (voxel >> 16) != weight || std::abs(found - tsdf) > 2e-4f;
    }
    EXPECT_GT(known, 20000);
    EXPECT_LE(differing, size_vox * size_vox * size_vox / 1000);
}

/// The wall comes back within a tenth of a voxel on average, its normal within 3 degrees.
TEST_F(DenseYardstick, CastsTheWallThatWasSwept) {
    SurfacePrediction prediction(device, shape);
    for (int i = 0; i < 3; ++i) volume.integrate(live, T_g_c);
    volume.raycast(T_g_c, prediction);
    const std::vector<float> found = test::cropped(shape, prediction.depth_m.read());
    const std::vector<float> normal_z = test::cropped(shape, [&] {
        const std::vector<float> planes = prediction.normals_c.read();
        return std::vector<float>(planes.begin() + 2 * static_cast<std::ptrdiff_t>(map_pixels(shape)),
                                  planes.end());
    }());
    double error_m = 0.0;
    int hits = 0, astray = 0;
    for (int y = 20; y < 100; ++y) {
        for (int x = 36; x < 124; ++x) {
            const auto at = static_cast<std::size_t>(y * k.width_px + x);
            if (found[at] <= 0.0f) continue;
            ++hits;
            error_m += static_cast<double>(std::abs(found[at] - wall_m(x, y)));
            astray += std::abs(normal_z[at] + 1.0f / std::hypot(1.0f, 0.3f)) > 0.05f;
        }
    }
    EXPECT_GT(hits, 6500);
    EXPECT_LT(error_m / hits, 0.1 * static_cast<double>(voxel_m));
    EXPECT_LT(astray, hits / 50);
}

}  // namespace
}  // namespace touchstone
