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

/// Listing 3 of the yardstick for one ray, in plain C++, on the voxels that the device swept.
class PlainRay {
  public:
    PlainRay(std::vector<int> voxels, const Intrinsics& k, const RigidTransform& T_g_c)
        : voxels_(std::move(voxels)), k_(k), T_g_c_(T_g_c) {}

    /// Depth of the surface on a pixel's ray, 0 = none.
    float depth_m(int x, int y) const {
        float before_m = start_m, last = 1.0f;
        for (float t = start_m; inside(point(x, y, t)) || t < first_inside_m;) {
            const float value = nearest(point(x, y, t));
            if (value < 0.0f && last > 0.0f) return crossing_m(x, y, before_m, t);
            if (value < 0.0f) return 0.0f;
            last = value;
            before_m = t;
            t += std::max(voxel_m, 0.8f * truncation_m * value);
        }
        return 0.0f;
    }

  private:
    static constexpr float start_m = 0.4f, first_inside_m = 0.45f;

    /// In voxels.
    Eigen::Vector3f point(int x, int y, float z_m) const {
        const Eigen::Vector3f ray((static_cast<float>(x) - k_.cx_px) / k_.fx_px,
                                  (static_cast<float>(y) - k_.cy_px) / k_.fy_px, 1.0f);
        return T_g_c_ * Eigen::Vector3f(z_m * ray) / voxel_m;
    }
    static bool inside(const Eigen::Vector3f& p) {
        return p.minCoeff() >= 0.0f && p.maxCoeff() < static_cast<float>(size_vox);
    }
    float nearest(const Eigen::Vector3f& p) const {
        if (!inside(p)) return 1.0f;
        const Eigen::Vector3i i = p.cast<int>();
        const int voxel = voxels_[static_cast<std::size_t>((i.z() * size_vox + i.y()) * size_vox + i.x())];
        return (voxel >> 16) > 0 ? static_cast<float>(static_cast<std::int16_t>(voxel & 0xffff)) / 32766.0f
                                 : 1.0f;
    }
    float trilinear(const Eigen::Vector3f& p) const {
        const Eigen::Vector3f q = p.array() - 0.5f, f = q.array().floor(), a = q - f;
        float sum = 0.0f;
        for (int i = 0; i < 8; ++i) {
            const Eigen::Vector3f corner(static_cast<float>(i & 1), static_cast<float>((i >> 1) & 1),
                                         static_cast<float>(i >> 2));
            const Eigen::Vector3f share =
                corner.array() * a.array() + (1.0f - corner.array()) * (1.0f - a.array());
            sum += share.prod() * nearest(f + corner + Eigen::Vector3f::Constant(0.5f));
        }
        return sum;
    }
    float crossing_m(int x, int y, float before_m, float t) const {
        const float near = trilinear(point(x, y, before_m)), far = trilinear(point(x, y, t));
        if (near <= far) return t;
        return std::clamp(before_m + (t - before_m) * near / (near - far), before_m - voxel_m, t + voxel_m);
    }

    std::vector<int> voxels_;
    Intrinsics k_;
    RigidTransform T_g_c_;
};

/// Equal to 0.01 mm but for one ray in a hundred, where a step ends on a voxel's border.
TEST_F(DenseYardstick, CastsLikeTheListing) {
    SurfacePrediction prediction(device, shape);
    volume.integrate(live, T_g_c);
    volume.raycast(T_g_c, prediction);
    const std::vector<float> found = test::cropped(shape, prediction.depth_m.read());
    const PlainRay ray(volume.voxels().read(), k, T_g_c);
    int differing = 0, hits = 0, rays = 0;
    for (int y = 20; y < 100; ++y) {
        for (int x = 36; x < 124; ++x, ++rays) {
            const float expected_m = ray.depth_m(x, y);
            hits += expected_m > 0.0f;
            differing += std::abs(found[static_cast<std::size_t>(y * k.width_px + x)] - expected_m) > 1e-5f;
        }
    }
    EXPECT_GT(hits, 6500);
    EXPECT_LE(differing, rays / 100);
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
