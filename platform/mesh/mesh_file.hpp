#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace touchstone {

enum class MeshDetail {
    shape,  ///< corners and triangles: corners at one place are one
    look    ///< normals, made where the file has none, and colours, too
};

/// Triangles of a mesh file, in its own unit and axes.
struct MeshFile {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;  ///< of each position; empty without MeshDetail::look
    std::vector<std::array<std::uint8_t, 4>>
        colors;  ///< the same, red first; the material's where corners have none
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Reads any kind that assimp knows (OBJ, glTF, PLY, STL ...). Throws Error: no_input (no such file),
/// bad_data (not a mesh, without triangles, larger than 64 MiB or two million triangles, numbers that are
/// none); the message names the file.
MeshFile read_mesh_file(const std::filesystem::path& path, MeshDetail detail);

}  // namespace touchstone
