#pragma once

#include <filesystem>

#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

namespace touchstone::sim {

/// Reads the triangles of a mesh file of any kind that assimp knows (OBJ, PLY, STL ...), equal corners
/// welded. Throws Error: no_input (no such file), bad_data (not a mesh, or without triangles); the message
/// names the file.
TriangleMesh read_mesh(const std::filesystem::path& path);

/// A bowl as a closed body of revolution about y, its opening at +y: 250 mm wide, walls of 6 mm with a round
/// lip, on a ring to stand on.
TriangleMesh make_bowl();

/// Moves the middle of the bounding box to the origin and scales its longest side to size_m. Throws
/// Error{bad_data} for a mesh without extent.
void fit(TriangleMesh& mesh, double size_m);

}  // namespace touchstone::sim
