#pragma once

#include <filesystem>

#include "pipeline/surface_mesh.hpp"

namespace touchstone {

/// Throws Error{usage} unless the path ends in .ply, .obj or .stl (in letters of any case): to be called
/// before the work that ends in such a file.
void check_mesh_ending(const std::filesystem::path& path);

/// Writes the mesh in metres, the old file kept until the new one is whole. By ending: PLY (binary; normals;
/// colours where the mesh has them), OBJ (normals; colours as `v x y z r g b`) or STL (binary; normals of the
/// triangles, no colours). A mesh without triangles gives a valid file with none. Throws Error: usage
/// (another ending), io_error.
void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh);

}  // namespace touchstone
