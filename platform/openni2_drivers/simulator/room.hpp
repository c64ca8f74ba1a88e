#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

namespace touchstone::sim {

/// A furnished corner: floor 3 m x 3 m at z = 0 around the origin, walls of 2.4 m at x = -1.5 m and y = 1.5
/// m, table, chair with legs of 20 to 30 mm, shelf, boxes, balls, a bin, and a board of 10 mm that stands
/// upright. The seed moves, turns, sizes and paints the furniture.
TriangleMesh make_room(std::uint64_t seed);

/// One flat wall in the plane y = 0, empty, 12 m x 8 m.
TriangleMesh make_wall();

/// Camera pose T_s_c at `eye_s` that looks at `target_s`, upright: x right, y down, z forward.
Eigen::Isometry3d look_at(const Eigen::Vector3d& eye_s, const Eigen::Vector3d& target_s);

/// Where a camera starts before each scene, and the middle of what it looks at: metres along its axis.
struct Viewpoint {
    Eigen::Isometry3d T_s_c = Eigen::Isometry3d::Identity();
    double pivot_m = 1.0;
};
Viewpoint room_viewpoint();
Viewpoint wall_viewpoint();

}  // namespace touchstone::sim
