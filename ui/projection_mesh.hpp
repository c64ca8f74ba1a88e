#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/surface_grid.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

/// The surface a projector lights, as triangles in the scan's frame.
struct ProjectionMesh {
    std::vector<Eigen::Vector3f> corners_g_m;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct ProjectionMeshConfig {
    int most_gap = 6;      ///< grid steps: holes not wider are filled from both sides
    float jump_m = 0.03f;  ///< between neighbours, beyond what the grid's own steps make: no surface there
};

/// Two triangles to each cell of the grid whose corners are there and on one surface.
ProjectionMesh make_projection_mesh(const SurfaceGrid& grid, const ProjectionMeshConfig& config = {});

/// The area alone (scan frame), in cells so small that a lens bends them little.
ProjectionMesh make_flat_mesh(const InteractiveArea& area_g);

}  // namespace touchstone
