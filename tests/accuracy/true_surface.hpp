#pragma once

#include "pipeline/surface_mesh.hpp"
#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

namespace touchstone {

/// A mesh of the simulator, in its own frame and metres, without normals and colours.
inline SurfaceMesh surface_of(const sim::TriangleMesh& mesh) {
    SurfaceMesh surface;
    for (const auto& v : mesh.vertices) surface.vertices_g_m.emplace_back(v);
    for (const auto& t : mesh.triangles)
        surface.triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                                     static_cast<std::uint32_t>(t[2])});
    return surface;
}

}  // namespace touchstone
