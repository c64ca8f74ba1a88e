#include "platform/openni2_drivers/simulator/mesh_distance.hpp"

#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/random.hpp"
#include "platform/openni2_drivers/simulator/room.hpp"

namespace touchstone::sim {
namespace {

using Eigen::Vector3d;

Vector3d anywhere(Random& random, float reach_m) {
    Vec3 point;
    for (int i = 0; i < 3; ++i) point[i] = random.uniform(-reach_m, reach_m);
    return point.cast<double>();
}

TEST(MeshDistance, OfABoxIsTheFormulas) {
    TriangleMesh mesh;
    add_box(mesh, Placement{}, {0.5F, 0.25F, 0.125F}, Vec3::Ones());
    const MeshDistance distance(mesh);
    Random random(1, 0);
    for (int i = 0; i < 2000; ++i) {
        const Vector3d p = anywhere(random, 1.0F);
        const Vector3d q = p.cwiseAbs() - Vector3d(0.5, 0.25, 0.125);
        const double expected = q.maxCoeff() > 0.0 ? q.cwiseMax(0.0).norm() : -q.maxCoeff();
        EXPECT_NEAR(distance.distance_m(p), expected, 1e-12);
    }
}

/// Ternary search over the triangle's two coordinates: slow, and unlike the tree's formulas.
double distance_by_search(const TriangleMesh& mesh, std::size_t number, const Vector3d& p) {
    const auto& t = mesh.triangles[number];
    const Vector3d a = mesh.vertices[t[0]].cast<double>();
    const Vector3d ab = mesh.vertices[t[1]].cast<double>() - a;
    const Vector3d ac = mesh.vertices[t[2]].cast<double>() - a;
    const auto minimum = [](double most, auto f) {
        double least = 0.0;
        for (int i = 0; i < 60; ++i) {
            const double one = least + (most - least) / 3.0;
            const double two = most - (most - least) / 3.0;
            if (f(one) < f(two))
                most = two;
            else
                least = one;
        }
        return f(0.5 * (least + most));
    };
    return minimum(1.0, [&](double u) {
        return minimum(1.0 - u, [&](double v) { return (a + u * ab + v * ac - p).norm(); });
    });
}

TEST(MeshDistance, OfARoomIsTheLeastOfAllTriangles) {
    TriangleMesh mesh = make_room(1);
    mesh.triangles.resize(120);
    mesh.triangles.push_back({0, 0, 1});  // without area
    const MeshDistance distance(mesh);
    Random random(2, 0);
    for (int i = 0; i < 12; ++i) {
        const Vector3d p = anywhere(random, 1.8F);
        double expected = 1e9;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            expected = std::min(expected, distance_by_search(mesh, t, p));
        EXPECT_NEAR(distance.distance_m(p), expected, 1e-7);
    }
}

TEST(MeshDistance, SaysWhereTheNearestPointIs) {
    const TriangleMesh mesh = make_room(2);
    const MeshDistance distance(mesh);
    Random random(3, 0);
    for (int i = 0; i < 500; ++i) {
        const Vector3d p = anywhere(random, 1.8F);
        const MeshDistance::Nearest nearest = distance.nearest(p);
        EXPECT_NEAR((nearest.point - p).norm(), nearest.distance_m, 1e-12);
        EXPECT_LT(distance.distance_m(nearest.point), 1e-9);
        EXPECT_NEAR(distance_by_search(mesh, nearest.triangle, p), nearest.distance_m, 1e-7);
    }
}

TEST(MeshDistance, NeedsATriangle) { EXPECT_THROW(MeshDistance(TriangleMesh{}), std::invalid_argument); }

}  // namespace
}  // namespace touchstone::sim
