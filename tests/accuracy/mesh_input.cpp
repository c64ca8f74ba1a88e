#include "tests/accuracy/mesh_input.hpp"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/core.h>
#include <map>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

std::array<std::uint8_t, 3> color_of(const aiColor4D& color) {
    const auto byte = [](float value) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
    };
    return {byte(color.r), byte(color.g), byte(color.b)};
}

/// Formats repeat vertices for each triangle: those at exactly one place become one again.
class Welder {
  public:
    void add(SurfaceMesh& mesh, const aiMesh& part, float scale) {
        std::vector<std::uint32_t> index;
        for (unsigned i = 0; i < part.mNumVertices; ++i) {
            const aiVector3D& v = part.mVertices[i];
            const auto next = static_cast<std::uint32_t>(mesh.vertices_g_m.size());
            const auto [known, is_new] = index_of_.try_emplace({v.x, v.y, v.z}, next);
            index.push_back(known->second);
            if (!is_new) continue;
            mesh.vertices_g_m.emplace_back(v.x * scale, v.y * scale, v.z * scale);
            if (part.HasVertexColors(0)) mesh.colors.push_back(color_of(part.mColors[0][i]));
        }
        for (unsigned i = 0; i < part.mNumFaces; ++i) {
            const aiFace& face = part.mFaces[i];
            if (face.mNumIndices != 3) continue;  // points and lines
            mesh.triangles.push_back(
                {index[face.mIndices[0]], index[face.mIndices[1]], index[face.mIndices[2]]});
        }
    }

  private:
    std::map<std::array<float, 3>, std::uint32_t> index_of_;
};

}  // namespace

SurfaceMesh read_mesh(const std::filesystem::path& path, float scale) {
    if (!std::filesystem::exists(path)) {
        throw Error(ExitStatus::no_input,
                    fmt::format("no mesh at {}; give a PLY, OBJ or STL file", path.string()));
    }
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFile(path.string(), aiProcess_ValidateDataStructure | aiProcess_Triangulate);
    SurfaceMesh mesh;
    Welder welder;
    for (unsigned i = 0; scene != nullptr && i < scene->mNumMeshes; ++i) {
        welder.add(mesh, *scene->mMeshes[i], scale);
    }
    if (mesh.triangles.empty()) {
        throw Error(ExitStatus::bad_data, fmt::format("{}: no triangles can be read from it", path.string()));
    }
    if (mesh.colors.size() != mesh.vertices_g_m.size()) mesh.colors.clear();
    return mesh;
}

}  // namespace touchstone
