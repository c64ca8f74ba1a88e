#pragma once

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <utility>

#include "pipeline/surface_mesh.hpp"

namespace touchstone::test {

struct Topology {
    int edges = 0;
    int open_edges = 0;        ///< directed sides without exactly one triangle turned the other way
    int pinched_vertices = 0;  ///< whose triangles do not form one fan
    int euler = 0;             ///< vertices - edges + triangles
    float least_area_m2 = 1e9f;
    double volume_m3 = 0.0;  ///< inside; negative where the triangles are turned inside out
};

inline Topology topology_of(const SurfaceMesh& mesh) {
    Topology result;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    std::vector<std::map<std::uint32_t, std::uint32_t>> around(mesh.vertices_g_m.size());
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++sides[{t[k], t[(k + 1) % 3]}];
            around[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
        }
        const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
            return mesh.vertices_g_m[t[k]].template cast<double>();
        };
        const Eigen::Vector3d a = corner(0), b = corner(1), c = corner(2);
        result.volume_m3 += a.dot(b.cross(c)) / 6.0;
        result.least_area_m2 =
            std::min(result.least_area_m2, static_cast<float>((b - a).cross(c - a).norm()) / 2);
    }
    for (const auto& [side, count] : sides) {
        const auto other = sides.find({side.second, side.first});
        const bool paired = count == 1 && other != sides.end() && other->second == 1;
        result.open_edges += !paired;
        result.edges += side.first < side.second || other == sides.end();
    }
    for (const auto& fan : around) {
        if (fan.empty()) continue;
        std::set<std::uint32_t> seen;
        for (auto at = fan.begin(); at != fan.end() && seen.insert(at->first).second;
             at = fan.find(at->second)) {
        }
        result.pinched_vertices += seen.size() != fan.size();
    }
    result.euler =
        static_cast<int>(mesh.vertices_g_m.size()) - result.edges + static_cast<int>(mesh.triangles.size());
    return result;
}

inline float area_m2(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const Eigen::Vector3f &a = mesh.vertices_g_m[t[0]], &b = mesh.vertices_g_m[t[1]],
                          &c = mesh.vertices_g_m[t[2]];
    return (b - a).cross(c - a).norm() / 2.0f;
}

/// Unit normal of a triangle.
inline Eigen::Vector3f face_normal(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const Eigen::Vector3f &a = mesh.vertices_g_m[t[0]], &b = mesh.vertices_g_m[t[1]],
                          &c = mesh.vertices_g_m[t[2]];
    return (b - a).cross(c - a).normalized();
}

}  // namespace touchstone::test
