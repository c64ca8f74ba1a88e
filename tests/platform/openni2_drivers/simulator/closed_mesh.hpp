#pragma once

#include <Eigen/Geometry>
#include <map>
#include <utility>

#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

namespace touchstone::sim {

/// Sum of the signed tetrahedra to the origin: positive where triangles run counter-clockwise seen from
/// outside.
inline double volume_m3(const TriangleMesh& mesh) {
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += mesh.vertices[a].cast<double>().dot(
                      mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>())) /
                  6.0;
    return volume;
}

/// Every directed edge once, its reverse once.
inline bool is_closed(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    for (const auto& [edge, count] : edges)
        if (count != 1 || edges.count({edge.second, edge.first}) == 0) return false;
    return true;
}

}  // namespace touchstone::sim
