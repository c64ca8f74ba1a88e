#include "tests/accuracy/closest_point.hpp"

#include <gtest/gtest.h>
#include <random>

namespace touchstone {
namespace {

Eigen::Vector3f random_point(std::mt19937& random) {
    std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
    const float x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return {x, y, z};
}

/// Least distance to a fine grid of points on the triangle.
float sampled_distance(const Eigen::Vector3f& p, const std::array<Eigen::Vector3f, 3>& t) {
    float least = 1e9f;
    for (int i = 0; i <= 60; ++i) {
        for (int j = 0; i + j <= 60; ++j) {
            const float u = static_cast<float>(i) / 60.0f, v = static_cast<float>(j) / 60.0f;
            least = std::min(least, (t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - p).norm());
        }
    }
    return least;
}

TEST(ClosestPoint, OfATriangleIsTheNearestOfItsPoints) {
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        const std::array<Eigen::Vector3f, 3> triangle = {random_point(random), random_point(random),
                                                         random_point(random)};
        const Eigen::Vector3f p = 2.0f * random_point(random);
        const Eigen::Vector3f closest = closest_on_triangle(p, triangle);
        const float distance = (closest - p).norm(), sampled = sampled_distance(p, triangle);
        EXPECT_LE(distance, sampled + 1e-5f);
        // Neighbours of the grid are at most 2 sqrt(3) / 60 apart.
        EXPECT_GE(distance, sampled - 0.06f);
        EXPECT_LT(sampled_distance(closest, triangle), 0.06f) << "it lies on the triangle";
    }
}

TEST(ClosestPoint, OfAMeshIsTheNearestOfAllTriangles) {
    std::mt19937 random(4);
    SurfaceMesh mesh;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const Eigen::Vector3f middle = 3.0f * random_point(random);
        for (int k = 0; k < 3; ++k) mesh.vertices_g_m.push_back(middle + 0.3f * random_point(random));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const DistanceToMesh distance(mesh);
    for (int i = 0; i < 300; ++i) {
        const Eigen::Vector3f p = 4.0f * random_point(random);
        float least = 1e9f;
        for (const auto& t : mesh.triangles) {
            const std::array<Eigen::Vector3f, 3> corners = {mesh.vertices_g_m[t[0]], mesh.vertices_g_m[t[1]],
                                                            mesh.vertices_g_m[t[2]]};
            least = std::min(least, (closest_on_triangle(p, corners) - p).norm());
        }
        const ClosestPoint found = distance.closest(p);
        EXPECT_NEAR(found.distance_m, least, 1e-6f);
        EXPECT_NEAR((found.point_m - p).norm(), least, 1e-6f);
        EXPECT_NEAR(found.normal.norm(), 1.0f, 1e-5f);
    }
}

TEST(ClosestPoint, ManyEqualTrianglesAreNoTrouble) {
    SurfaceMesh mesh;
    mesh.vertices_g_m = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    mesh.triangles.assign(1000, {0, 1, 2});
    const ClosestPoint found = DistanceToMesh(mesh).closest({0.25f, 0.25f, -2.0f});
    EXPECT_FLOAT_EQ(found.distance_m, 2.0f);
    EXPECT_EQ(found.normal, Eigen::Vector3f::UnitZ());
}

}  // namespace
}  // namespace touchstone
