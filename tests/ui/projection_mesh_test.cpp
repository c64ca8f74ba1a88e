#include "ui/projection_mesh.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

/// 20 by 15 points, 4 mm apart.
SurfaceGrid flat_grid() {
    SurfaceGrid grid;
    grid.width = 20;
    grid.height = 15;
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x)
            grid.points_g_m.emplace_back(0.004f * static_cast<float>(x), 0.004f * static_cast<float>(y),
                                         0.001f * static_cast<float>(x + 2 * y), 1.f);
    return grid;
}

void cut(SurfaceGrid& grid, int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            grid.points_g_m[static_cast<std::size_t>(20 * y + x)] = Eigen::Vector4f::Zero();
}

constexpr std::size_t all_triangles = 2 * 19 * 14;

TEST(ProjectionMesh, HasTwoTrianglesACell) {
    const ProjectionMesh mesh = make_projection_mesh(flat_grid());
    EXPECT_EQ(mesh.triangles.size(), all_triangles);
    EXPECT_EQ(mesh.corners_g_m.size(), 300U);
}

TEST(ProjectionMesh, SmallHolesAreFilledFromTheirEdges) {
    const SurfaceGrid whole = flat_grid();
    SurfaceGrid holed = whole;
    cut(holed, 4, 4, 9, 8);
    cut(holed, 12, 3, 13, 4);
    const ProjectionMesh mesh = make_projection_mesh(holed);
    EXPECT_EQ(mesh.triangles.size(), all_triangles);
    for (std::size_t i = 0; i < 300; ++i)
        EXPECT_LT((mesh.corners_g_m[i] - whole.points_g_m[i].head<3>()).norm(), 1e-6f) << i;
}

TEST(ProjectionMesh, WideHolesAndMissingEdgesStayOpen) {
    SurfaceGrid holed = flat_grid();
    cut(holed, 5, 3, 14, 12);
    EXPECT_EQ(make_projection_mesh(holed).triangles.size(), all_triangles - 2U * 10U * 10U + 2U)
        << "in two corners of the hole a triangle remains";
    SurfaceGrid edge = flat_grid();
    cut(edge, 0, 0, 2, 15);
    EXPECT_EQ(make_projection_mesh(edge).triangles.size(), 2U * 17U * 14U);
}

TEST(ProjectionMesh, NothingSpansAJump) {
    SurfaceGrid step = flat_grid();
    for (std::size_t i = 0; i < step.points_g_m.size(); ++i)
        if (i % 20 >= 10) step.points_g_m[i].z() -= 0.06f;
    cut(step, 9, 5, 11, 7);  // its two sides are filled on their own
    const ProjectionMesh mesh = make_projection_mesh(step);
    EXPECT_EQ(mesh.triangles.size(), 2U * 18U * 14U);
    for (const auto& triangle : mesh.triangles) {
        const auto is_left = [](std::uint32_t corner) { return corner % 20 < 10; };
        EXPECT_EQ(is_left(triangle[0]), is_left(triangle[1]));
        EXPECT_EQ(is_left(triangle[0]), is_left(triangle[2]));
    }
}

/// Steps of 40 mm between neighbours are no jumps where all are so far apart.
TEST(ProjectionMesh, CoarseGridsHoldTogether) {
    SurfaceGrid coarse = flat_grid();
    for (Eigen::Vector4f& point : coarse.points_g_m) point.head<3>() *= 10.f;
    EXPECT_EQ(make_projection_mesh(coarse).triangles.size(), all_triangles);
}

TEST(ProjectionMesh, AnEmptyGridHasNoTriangles) {
    EXPECT_TRUE(make_projection_mesh({}).triangles.empty());
    SurfaceGrid nothing = flat_grid();
    cut(nothing, 0, 0, 20, 15);
    EXPECT_TRUE(make_projection_mesh(nothing).triangles.empty());
}

TEST(ProjectionMesh, TheFlatMeshFillsTheArea) {
    const ProjectionMesh mesh = make_flat_mesh({{1.f, 2.f, 3.f}, {0.f, 1.5f, 0.f}, {0.f, 0.f, 0.8f}});
    EXPECT_LT((mesh.corners_g_m.front() - Eigen::Vector3f(1.f, 2.f, 3.f)).norm(), 1e-6f);
    EXPECT_LT((mesh.corners_g_m.back() - Eigen::Vector3f(1.f, 3.5f, 3.8f)).norm(), 1e-6f);
    EXPECT_GE(mesh.triangles.size(), 100U);
}

}  // namespace
}  // namespace touchstone
