#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include "tests/platform/openni2_drivers/simulator/closed_mesh.hpp"

namespace touchstone::sim {
namespace {

const Placement tilted{{0.3F, -0.2F, 1.0F},
                       Eigen::AngleAxisf(0.7F, Vec3(1, 2, 3).normalized()).toRotationMatrix()};

TEST(TriangleMesh, ABoxIsClosedAndOfItsVolume) {
    TriangleMesh mesh;
    add_box(mesh, tilted, {0.1F, 0.2F, 0.3F}, Vec3::Ones());
    EXPECT_EQ(mesh.triangles.size(), 12U);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume_m3(mesh), 0.2 * 0.4 * 0.6, 1e-6);
}

TEST(TriangleMesh, ABallIsClosedAndItsCornersLieOnIt) {
    TriangleMesh mesh;
    add_ball(mesh, {1.0F, 2.0F, 3.0F}, 0.25F, Vec3::Ones());
    EXPECT_TRUE(is_closed(mesh));
    // A ball of 20 by 40 facets has 1.5 % less volume than the sphere.
    EXPECT_NEAR(volume_m3(mesh), 4.0 / 3.0 * std::numbers::pi * 0.25 * 0.25 * 0.25, 0.0013);
    for (const Vec3& vertex : mesh.vertices) EXPECT_NEAR((vertex - Vec3(1, 2, 3)).norm(), 0.25F, 1e-6F);
}

TEST(TriangleMesh, ACylinderStandsAlongItsPlacement) {
    TriangleMesh mesh;
    add_cylinder(mesh, tilted, 0.1F, 0.4F, Vec3::Ones());
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume_m3(mesh), std::numbers::pi * 0.01 * 0.8, 0.0003);
    EXPECT_NEAR((mesh.vertices.back() - tilted.center - 0.4F * tilted.axes.col(2)).norm(), 0.0F, 1e-6F);
}

TEST(TriangleMesh, EveryTriangleHasItsColourAndItsNormal) {
    TriangleMesh mesh;
    add_quad(mesh, Vec3::Zero(), {2.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, {0.1F, 0.2F, 0.3F});
    add_box(mesh, tilted, {0.1F, 0.2F, 0.3F}, Vec3::Ones());
    ASSERT_EQ(mesh.albedo.size(), mesh.triangles.size());
    EXPECT_EQ(mesh.albedo[1], Vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(triangle_normal(mesh, 0), Vec3(Vec3::UnitZ()));
    mesh.triangles.push_back({0, 0, 1});
    EXPECT_EQ(triangle_normal(mesh, mesh.triangles.size() - 1), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace touchstone::sim
