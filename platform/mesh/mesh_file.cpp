#include "platform/mesh/mesh_file.hpp"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/core.h>
#include <string_view>
#include <system_error>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

constexpr std::uintmax_t most_bytes = 64U << 20;
constexpr std::size_t most_triangles = 2'000'000;
constexpr std::array<std::uint8_t, 4> clay{184, 158, 128, 255};

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view reason) {
    throw Error(ExitStatus::bad_data, fmt::format("mesh file {}: {}", path.string(), reason));
}

Eigen::Vector3f to_eigen(const aiVector3D& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::array<std::uint8_t, 4> to_bytes(const aiColor4D& color) {
    const auto byte = [](float share) {
        return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
    };
    return {byte(color.r), byte(color.g), byte(color.b), 255};
}

std::array<std::uint8_t, 4> material_color(const aiScene& scene, const aiMesh& part) {
    aiColor4D color;
    if (part.mMaterialIndex >= scene.mNumMaterials ||
        scene.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS)
        return clay;
    return to_bytes(color);
}

void append(MeshFile& mesh, const aiScene& scene, const aiMesh& part, MeshDetail detail) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto of_material = material_color(scene, part);
    for (unsigned int i = 0; i < part.mNumVertices; ++i) {
        mesh.positions.push_back(to_eigen(part.mVertices[i]));
        if (detail == MeshDetail::shape) continue;
        mesh.normals.push_back(part.HasNormals() ? to_eigen(part.mNormals[i]) : Eigen::Vector3f::UnitY());
        mesh.colors.push_back(part.HasVertexColors(0) ? to_bytes(part.mColors[0][i]) : of_material);
    }
    for (unsigned int i = 0; i < part.mNumFaces; ++i) {
        const aiFace& face = part.mFaces[i];
        if (face.mNumIndices != 3) continue;
        mesh.triangles.push_back(
            {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
}

void check_file(const std::filesystem::path& path) {
    std::error_code code;
    if (!std::filesystem::exists(path, code))
        throw Error(ExitStatus::no_input, fmt::format("no mesh file {}", path.string()));
    if (!std::filesystem::is_regular_file(path, code)) refuse(path, "is not a file");
    if (std::filesystem::file_size(path, code) > most_bytes || code) refuse(path, "is larger than 64 MiB");
}

unsigned int steps_for(Assimp::Importer& importer, MeshDetail detail) {
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const unsigned int steps = aiProcess_Triangulate | aiProcess_SortByPType |
                               aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices;
    if (detail == MeshDetail::look) return steps | aiProcess_GenSmoothNormals;
    // Corners that differ only in what is not used are one.
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TEXCOORDS |
                                                            aiComponent_COLORS |
                                                            aiComponent_TANGENTS_AND_BITANGENTS);
    return steps | aiProcess_RemoveComponent;
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& path, MeshDetail detail) {
    check_file(path);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path.string(), steps_for(importer, detail));
    if (scene == nullptr) {
        std::string reason = importer.GetErrorString();
        reason.resize(std::min(reason.find('\n'), reason.size()));
        refuse(path, reason.empty() ? "is not a mesh" : reason);
    }
    MeshFile mesh;
    for (unsigned int i = 0; i < scene->mNumMeshes; ++i) append(mesh, *scene, *scene->mMeshes[i], detail);
    if (mesh.triangles.empty()) refuse(path, "has no triangles");
    if (mesh.triangles.size() > most_triangles) refuse(path, "has more than two million triangles");
    const auto finite = [](const Eigen::Vector3f& v) { return v.allFinite(); };
    if (!std::ranges::all_of(mesh.positions, finite) || !std::ranges::all_of(mesh.normals, finite))
        refuse(path, "has a corner that is not a number");
    return mesh;
}

}  // namespace touchstone
