#include "platform/openni2_drivers/simulator/rasteriser.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/random.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"

namespace touchstone::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const Intrinsics camera = kinect_intrinsics();

Raster drawn(const TriangleMesh& mesh, const Isometry3d& T_c_s = Isometry3d::Identity()) {
    Raster raster;
    rasterise(mesh, T_c_s, camera, raster);
    return raster;
}

Vector3d ray_c(std::size_t pixel) {
    return {(static_cast<double>(pixel % 640) - 319.5) / static_cast<double>(camera.fx_px),
            (static_cast<double>(pixel / 640) - 239.5) / static_cast<double>(camera.fy_px), 1.0};
}

/// The slow way: every ray with every triangle (Moeller and Trumbore), z; infinity where nothing is hit.
double traced(const TriangleMesh& mesh, const Isometry3d& T_c_s, const Vector3d& ray) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : mesh.triangles) {
        const Vector3d a = T_c_s * mesh.vertices[t[0]].cast<double>();
        const Vector3d ab = T_c_s * mesh.vertices[t[1]].cast<double>() - a;
        const Vector3d ac = T_c_s * mesh.vertices[t[2]].cast<double>() - a;
        const double scale = ab.dot(ray.cross(ac));
        const double u = -a.dot(ray.cross(ac)) / scale;
        const double v = ray.dot((-a).cross(ab)) / scale;
        const double z = ac.dot((-a).cross(ab)) / scale;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && z >= 0.05) nearest = std::min(nearest, z);
    }
    return nearest;
}

/// A few hundred triangles of all sizes around the camera, many of them half behind it.
TriangleMesh scattered(int count) {
    Random random(3, 0);
    TriangleMesh mesh;
    for (int i = 0; i < count; ++i) {
        const float size_m = i % 5 == 0 ? 2.0F : 0.2F;
        const Vec3 middle{random.uniform(-1.5F, 1.5F), random.uniform(-1.0F, 1.0F),
                          random.uniform(-0.3F, 3.0F)};
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int k = 0; k < 3; ++k)
            mesh.vertices.push_back(middle +
                                    size_m * Vec3{random.normal(), random.normal(), random.normal()});
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.albedo.push_back(Vec3::Constant(0.5F));
    }
    return mesh;
}

TEST(Rasteriser, APlaneAtASlantIsExactAtEveryPixel) {
    TriangleMesh mesh;
    add_quad(mesh, {-20.0F, -20.0F, -9.0F}, {40.0F, 0.0F, 14.0F}, {0.0F, 40.0F, 10.0F}, Vec3::Ones());
    const Raster raster = drawn(mesh);
    const Vector3d normal = Vector3d(40.0, 0.0, 14.0).cross(Vector3d(0.0, 40.0, 10.0));
    const double offset = normal.dot(Vector3d(-20.0, -20.0, -9.0));
    int seen = 0;
    for (std::size_t i = 0; i < raster.depth_m.size(); ++i) {
        const double z = offset / normal.dot(ray_c(i));
        if (z < 0.05) continue;
        EXPECT_NEAR(static_cast<double>(raster.depth_m[i]) / z, 1.0, 2e-7) << i;
        ++seen;
    }
    EXPECT_GT(seen, 300000);
}

TEST(Rasteriser, AFineBallIsASphereToItsFacets) {
    TriangleMesh mesh;
    std::vector<Eigen::Vector2f> profile;
    for (int i = 0; i <= 200; ++i) {
        const float angle = std::numbers::pi_v<float> * (static_cast<float>(i) / 200.0F - 0.5F);
        profile.emplace_back(0.5F * std::cos(angle), 0.5F * std::sin(angle));
    }
    add_revolved(mesh, {0.1F, -0.05F, 2.0F}, profile, 400, Vec3::Ones());
    const Raster raster = drawn(mesh);
    const Vector3d middle(0.1, -0.05, 2.0);
    int seen = 0;
    for (std::size_t i = 0; i < raster.depth_m.size(); ++i) {
        const Vector3d ray = ray_c(i);
        const double along = ray.dot(middle) / ray.squaredNorm();
        const double aside = (along * ray - middle).norm();
        // Facets of 8 mm lie up to 0.03 mm inside the sphere, which shows as more along a slanting ray.
        if (aside > 0.45) continue;
        const double z = along - std::sqrt((0.25 - aside * aside) / ray.squaredNorm());
        EXPECT_NEAR(static_cast<double>(raster.depth_m[i]), z, 1e-4);
        ++seen;
    }
    EXPECT_GT(seen, 50000);
}

TEST(Rasteriser, SeesWhatRaysMeetAlsoAroundTheNearPlane) {
    const TriangleMesh mesh = scattered(150);
    Isometry3d T_c_s(Eigen::AngleAxisd(0.3, Vector3d(1, -2, 0.5).normalized()));
    T_c_s.translation() = Vector3d(0.1, 0.2, 0.05);
    const Raster raster = drawn(mesh, T_c_s);
    int different = 0;
    int tested = 0;
    for (std::size_t i = 0; i < raster.depth_m.size(); i += 23, ++tested) {
        const double expected = traced(mesh, T_c_s, ray_c(i));
        const auto z = static_cast<double>(raster.depth_m[i]);
        EXPECT_EQ(raster.triangle[i] == Raster::no_triangle, std::isinf(raster.depth_m[i]));
        const bool same = std::isinf(expected) ? std::isinf(z) : std::abs(z / expected - 1.0) < 1e-6;
        different += !same;
    }
    // Rays within rounding of a triangle's edge may go either way.
    EXPECT_LE(different, 2) << "of " << tested;
}

TEST(Rasteriser, NearerThanFiftyMillimetresNothingIsSeen) {
    // A wall at 2 m, and before it a surface through (0, 0, 50 mm), or square to the axis at 49 mm.
    for (const float rise : {0.0F, 0.3F}) {
        const float from_m = rise > 0.0F ? 0.05F - 2.0F * rise : 0.049F;
        TriangleMesh mesh;
        add_quad(mesh, {-1.0F, -1.0F, from_m}, {2.0F, 0.0F, 2.0F * rise}, {0.0F, 2.0F, 2.0F * rise},
                 Vec3::Ones());
        add_quad(mesh, {-5.0F, -5.0F, 2.0F}, {10.0F, 0.0F, 0.0F}, {0.0F, 10.0F, 0.0F}, Vec3::Ones());
        const std::vector<float> depth_m = drawn(mesh).depth_m;
        const float least_m = *std::min_element(depth_m.begin(), depth_m.end());
        EXPECT_NEAR(least_m, rise > 0.0F ? 0.05F : 2.0F, 1e-3F);
        EXPECT_GE(least_m, 0.05F - 1e-8F);
    }
}

TEST(Rasteriser, TheNearerOfTwoFacesIsSeenWhateverTheOrder) {
    for (const bool first : {true, false}) {
        TriangleMesh mesh;
        for (const bool near : {first, !first})
            add_quad(mesh, {-1.0F, -1.0F, near ? 1.0F : 2.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 0.0F},
                     Vec3::Ones());
        const Raster raster = drawn(mesh);
        EXPECT_FLOAT_EQ(raster.depth_m[240 * 640 + 320], 1.0F);
        EXPECT_EQ(raster.triangle[240 * 640 + 320] / 2, first ? 0 : 1);
    }
}

TEST(Rasteriser, NoPixelFallsBetweenNeighbours) {
    TriangleMesh mesh;
    add_ball(mesh, Vec3::Zero(), 5.0F, Vec3::Ones());
    for (int i = 0; i < 5; ++i) {
        const Isometry3d T_c_s(Eigen::AngleAxisd(0.37 * i, Vector3d(1, 2, -1).normalized()));
        for (const float z : drawn(mesh, T_c_s).depth_m) ASSERT_TRUE(z > 3.0F && z <= 5.0F);
    }
}

TEST(Rasteriser, APixelThatIsNotHitAtItsCentreShowsNothing) {
    TriangleMesh mesh;
    // From column 99.6 to 102.4 and row 49.6 to 50.4 at 1 m: the centres of three pixels.
    const Vec3 corner((99.6F - camera.cx_px) / camera.fx_px, (49.6F - camera.cy_px) / camera.fy_px, 1.0F);
    add_quad(mesh, corner, {2.8F / camera.fx_px, 0.0F, 0.0F}, {0.0F, 0.8F / camera.fy_px, 0.0F},
             Vec3::Ones());
    const Raster raster = drawn(mesh);
    int seen = 0;
    for (const float z : raster.depth_m) seen += std::isfinite(z);
    EXPECT_EQ(seen, 3);
    for (const std::size_t u : {100U, 101U, 102U}) EXPECT_FLOAT_EQ(raster.depth_m[50 * 640 + u], 1.0F);
}

TEST(Rasteriser, BothFacesAreLitAndNothingIsBlack) {
    TriangleMesh mesh;
    add_quad(mesh, {-1.0F, -1.0F, 2.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, {1.0F, 0.5F, 0.0F});
    const auto color = [&] {
        const Raster raster = drawn(mesh);
        std::vector<std::uint8_t> rgb;
        shade_raster(raster, mesh, Isometry3d::Identity(), Eigen::Matrix3d::Identity(), camera, rgb);
        return rgb;
    };
    const std::vector<std::uint8_t> front = color();
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    EXPECT_EQ(front, color());
    const std::size_t left = 3 * (240 * 640 + 200);
    EXPECT_NEAR(front[left + 1], 0.5 * front[left], 1.0);
    EXPECT_GT(front[left], 30);
    EXPECT_EQ(front[3 * (240 * 640 + 600)], 0);
}

}  // namespace
}  // namespace touchstone::sim
