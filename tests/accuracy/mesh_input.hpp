#pragma once

#include <filesystem>

#include "pipeline/surface_mesh.hpp"

namespace touchstone {

/// All triangles of a PLY, OBJ or STL file, in the file's own frame, coordinates times `scale`; colours
/// where the file has them; no normals. Throws Error: no_input (no such file), bad_data (cannot be read or
/// has no triangles).
SurfaceMesh read_mesh(const std::filesystem::path& path, float scale = 1.0f);

}  // namespace touchstone
