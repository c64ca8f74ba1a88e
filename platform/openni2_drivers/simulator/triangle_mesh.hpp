#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "platform/openni2_drivers/simulator/geometry.hpp"

namespace touchstone::sim {

/// Triangles in metres, in the scene frame s (z up). Both faces of a triangle are seen.
struct TriangleMesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
    std::vector<Vec3> albedo;                             ///< of each triangle, 0..1 red green blue
};

/// Where a body stands: its middle, and its axes as columns.
struct Placement {
    Vec3 center = Vec3::Zero();
    Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();
};

/// Turned about the vertical.
Placement upright(const Vec3& center, float yaw_rad);

// Each adds a closed body; equal arguments give equal triangles.
void add_box(TriangleMesh& mesh, const Placement& placement, const Vec3& half, const Vec3& albedo);
void add_ball(TriangleMesh& mesh, const Vec3& center, float radius_m, const Vec3& albedo);
/// Along the placement's z.
void add_cylinder(TriangleMesh& mesh, const Placement& placement, float radius_m, float half_m,
                  const Vec3& albedo);

/// Adds a body of revolution about the vertical through `foot`. The profile runs from pole to pole, (distance
/// from the axis, height) in metres, anticlockwise with the axis to its left; both ends lie on the axis.
void add_revolved(TriangleMesh& mesh, const Vec3& foot, const std::vector<Eigen::Vector2f>& profile,
                  int segments, const Vec3& albedo);

/// Adds the flat quadrilateral corner, corner + along, corner + along + up, corner + up.
void add_quad(TriangleMesh& mesh, const Vec3& corner, const Vec3& along, const Vec3& up, const Vec3& albedo);

/// Unit normal by the order of the corners; zero for a triangle without area.
Vec3 triangle_normal(const TriangleMesh& mesh, std::size_t triangle);

}  // namespace touchstone::sim
