#include "platform/openni2_drivers/simulator/room.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/rasteriser.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"

namespace touchstone::sim {
namespace {

constexpr std::int32_t shell_triangles = 6;  ///< floor and two walls come first

Raster seen(const TriangleMesh& mesh) {
    Raster raster;
    rasterise(mesh, room_viewpoint().T_s_c.inverse(), kinect_intrinsics(), raster);
    return raster;
}

TEST(Room, FurnitureStandsInsideAndIsWellInView) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const TriangleMesh mesh = make_room(seed);
        for (const Vec3& vertex : mesh.vertices) {
            EXPECT_LE(vertex.head<2>().cwiseAbs().maxCoeff(), 1.5001F) << seed;
            EXPECT_TRUE(vertex.z() > -1e-4F && vertex.z() < 2.4001F) << seed;
        }
        const std::vector<std::int32_t> triangle = seen(mesh).triangle;
        const auto furniture = std::count_if(triangle.begin(), triangle.end(),
                                             [](std::int32_t t) { return t >= shell_triangles; });
        EXPECT_GT(furniture, 640 * 480 / 6) << seed;
        EXPECT_EQ(std::count(triangle.begin(), triangle.end(), Raster::no_triangle), 0) << seed;
    }
}

TEST(Room, TheSeedFurnishesIt) {
    const TriangleMesh one = make_room(1), same = make_room(1), other = make_room(2);
    EXPECT_EQ(one.vertices, same.vertices);
    EXPECT_EQ(one.albedo, same.albedo);
    const std::vector<float> depth_m = seen(one).depth_m, other_depth_m = seen(other).depth_m;
    int different = 0;
    for (std::size_t i = 0; i < depth_m.size(); ++i)
        different += std::abs(depth_m[i] - other_depth_m[i]) > 0.01F;
    EXPECT_GT(different, 640 * 480 / 20);
}

TEST(Room, LooksUpright) {
    const Eigen::Isometry3d T_s_c = look_at({1.0, 2.0, 3.0}, {1.0, 5.0, 3.0});
    EXPECT_TRUE(T_s_c.linear().isUnitary(1e-12));
    EXPECT_NEAR(T_s_c.linear().determinant(), 1.0, 1e-12);
    EXPECT_LT((T_s_c.linear().col(0) - Eigen::Vector3d::UnitX()).norm(), 1e-12) << "x to the right";
    EXPECT_LT((T_s_c.linear().col(1) + Eigen::Vector3d::UnitZ()).norm(), 1e-12) << "y down";
    EXPECT_LT((T_s_c.linear().col(2) - Eigen::Vector3d::UnitY()).norm(), 1e-12) << "z forward";
}

}  // namespace
}  // namespace touchstone::sim
