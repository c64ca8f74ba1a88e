#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/volume_snapshot.hpp"

namespace touchstone {

/// Triangles over shared vertices, in the volume's frame.
struct SurfaceMesh {
    std::vector<Eigen::Vector3f> vertices_g_m;
    std::vector<Eigen::Vector3f> normals_g;           ///< of each vertex, length 1, to free space
    std::vector<std::array<std::uint8_t, 3>> colors;  ///< red, green, blue of each vertex, or empty
    std::vector<std::array<std::uint32_t, 3>>
        triangles;  ///< vertices, counter-clockwise seen from free space
};

struct SurfaceMeshConfig {
    int min_weight = 3;            ///< voxels seen less often count as unknown; at least 1
    int min_piece_triangles = 50;  ///< connected pieces of fewer are left out; 0 keeps all
};

/// Marching cubes: the surface between voxels of TSDF <= 0 and > 0, in cells whose eight voxels are known,
/// with one vertex for each crossed edge of the voxel grid. A closed 2-manifold where the surface was seen
/// from all sides: it ends only at unknown voxels. Voxels nearer to the surface than a hundredth of a voxel
/// are taken to be so far from it, so that no triangle is degenerate. Colours where the snapshot has any;
/// grey where a vertex has none. Equal snapshots give equal meshes.
SurfaceMesh extract_surface(const VolumeSnapshot& snapshot, const SurfaceMeshConfig& config = {});

/// Removes pieces (triangles connected by vertices) of fewer than so many triangles, and unused vertices.
void remove_small_pieces(SurfaceMesh& mesh, int min_piece_triangles);

}  // namespace touchstone
