#include "pipeline/mesh_file.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/support/distance_snapshot.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/small_volume.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

SurfaceMesh sphere_mesh(bool with_colors) {
    const auto sphere = test::sphere_distance({0.3f, 0.32f, 0.35f}, 0.2f);
    SurfaceMesh mesh = extract_surface(test::snapshot_of(test::small_volume(), sphere));
    for (std::size_t i = 0; with_colors && i < mesh.vertices_g_m.size(); ++i) {
        mesh.colors.push_back({static_cast<std::uint8_t>(i % 251), 40, 255});
    }
    return mesh;
}

/// A mesh as assimp reads it; the importer owns the scene.
struct Opened {
    Assimp::Importer importer;
    const aiMesh* mesh = nullptr;
};

/// `joined`: vertices of equal places are one again (formats that repeat them), whatever their normals.
void open(Opened& opened, const std::filesystem::path& path, bool joined) {
    opened.importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_COLORS);
    const unsigned flags = joined ? aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices : 0U;
    const aiScene* scene = opened.importer.ReadFile(path.string(), flags | aiProcess_ValidateDataStructure);
    ASSERT_NE(scene, nullptr) << opened.importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, 1u);
    opened.mesh = scene->mMeshes[0];
}

Eigen::Vector3f vector_of(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Counts, and bounds to `tolerance_m`.
void expect_same_shape(const aiMesh& read, const SurfaceMesh& written, float tolerance_m) {
    EXPECT_EQ(read.mNumFaces, written.triangles.size());
    EXPECT_EQ(read.mNumVertices, written.vertices_g_m.size());
    Eigen::Vector3f low_read = Eigen::Vector3f::Constant(1e9f), low = low_read, high_read = -low, high = -low;
    for (unsigned i = 0; i < read.mNumVertices; ++i) {
        low_read = low_read.cwiseMin(vector_of(read.mVertices[i]));
        high_read = high_read.cwiseMax(vector_of(read.mVertices[i]));
    }
    for (const auto& vertex : written.vertices_g_m) {
        low = low.cwiseMin(vertex);
        high = high.cwiseMax(vertex);
    }
    EXPECT_LE((low - low_read).cwiseAbs().maxCoeff(), tolerance_m);
    EXPECT_LE((high - high_read).cwiseAbs().maxCoeff(), tolerance_m);
}

/// Every triangle's corners in order, and their normals where the file has them.
void expect_same_triangles(const aiMesh& read, const SurfaceMesh& written, bool normals) {
    ASSERT_EQ(read.mNumFaces, written.triangles.size());
    ASSERT_EQ(read.HasNormals(), true);
    for (unsigned t = 0; t < read.mNumFaces; ++t) {
        ASSERT_EQ(read.mFaces[t].mNumIndices, 3u);
        for (unsigned k = 0; k < 3; ++k) {
            const unsigned at = read.mFaces[t].mIndices[k], expected = written.triangles[t][k];
            const float off = (vector_of(read.mVertices[at]) - written.vertices_g_m[expected]).norm();
            ASSERT_LT(off, 1e-6f);
            if (!normals) continue;
            ASSERT_LT((vector_of(read.mNormals[at]) - written.normals_g[expected]).norm(), 1e-3f);
        }
    }
}

/// The part of a file before its binary data.
std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(MeshFile, PlyKeepsPlacesNormalsAndColours) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = sphere_mesh(true);
    write_mesh(folder / "a.ply", mesh);
    Opened opened;
    ASSERT_NO_FATAL_FAILURE(open(opened, folder / "a.ply", false));
    expect_same_shape(*opened.mesh, mesh, 0.0f);
    expect_same_triangles(*opened.mesh, mesh, true);
    ASSERT_TRUE(opened.mesh->HasVertexColors(0));
    for (unsigned t = 0; t < opened.mesh->mNumFaces; ++t) {
        const auto& color = opened.mesh->mColors[0][opened.mesh->mFaces[t].mIndices[0]];
        const auto& expected = mesh.colors[mesh.triangles[t][0]];
        ASSERT_NEAR(color.r * 255.0f, expected[0], 0.01f);
        ASSERT_NEAR(color.g * 255.0f, 40.0f, 0.01f);
        ASSERT_NEAR(color.b * 255.0f, 255.0f, 0.01f);
    }
}

TEST(MeshFile, PlyWithoutColours) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = sphere_mesh(false);
    write_mesh(folder / "a.PLY", mesh);
    Opened opened;
    ASSERT_NO_FATAL_FAILURE(open(opened, folder / "a.PLY", false));
    expect_same_shape(*opened.mesh, mesh, 0.0f);
    EXPECT_FALSE(opened.mesh->HasVertexColors(0));
}

TEST(MeshFile, PlyWhoseDataBeginWithALineFeedIsReadAsWell) {
    const TemporaryFolder folder;
    SurfaceMesh mesh = sphere_mesh(true);
    mesh.vertices_g_m[0].x() = 0.16f;  // 0x3e23d70a, the low byte first
    write_mesh(folder / "a.ply", mesh);
    Opened opened;
    ASSERT_NO_FATAL_FAILURE(open(opened, folder / "a.ply", false));
    expect_same_triangles(*opened.mesh, mesh, true);
}

TEST(MeshFile, ObjKeepsPlacesNormalsAndColours) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = sphere_mesh(true);
    write_mesh(folder / "a.obj", mesh);
    Opened opened, joined;
    ASSERT_NO_FATAL_FAILURE(open(opened, folder / "a.obj", false));
    expect_same_triangles(*opened.mesh, mesh, true);
    ASSERT_TRUE(opened.mesh->HasVertexColors(0));
    EXPECT_NEAR(opened.mesh->mColors[0][0].g * 255.0f, 40.0f, 0.1f);
    EXPECT_NEAR(opened.mesh->mColors[0][0].r * 255.0f, mesh.colors[mesh.triangles[0][0]][0], 0.1f);
    ASSERT_NO_FATAL_FAILURE(open(joined, folder / "a.obj", true));
    expect_same_shape(*joined.mesh, mesh, 1e-6f);
    write_mesh(folder / "plain.obj", sphere_mesh(false));
    Opened plain;
    ASSERT_NO_FATAL_FAILURE(open(plain, folder / "plain.obj", false));
    EXPECT_FALSE(plain.mesh->HasVertexColors(0));
    expect_same_triangles(*plain.mesh, mesh, true);
}

TEST(MeshFile, StlKeepsTheTriangles) {
    const TemporaryFolder folder;
    const SurfaceMesh mesh = sphere_mesh(true);
    write_mesh(folder / "a.Stl", mesh);
    EXPECT_EQ(std::filesystem::file_size(folder / "a.Stl"), 84 + 50 * mesh.triangles.size());
    Opened opened, joined;
    ASSERT_NO_FATAL_FAILURE(open(opened, folder / "a.Stl", false));
    expect_same_triangles(*opened.mesh, mesh, false);
    const aiVector3D* corners = opened.mesh->mVertices;
    for (unsigned t = 0; t < opened.mesh->mNumFaces; ++t) {
        const Eigen::Vector3f a = vector_of(corners[3 * t]), b = vector_of(corners[3 * t + 1]);
        const Eigen::Vector3f normal = (b - a).cross(vector_of(corners[3 * t + 2]) - a).normalized();
        ASSERT_GT(normal.dot(vector_of(opened.mesh->mNormals[3 * t])), 0.999f);
    }
    ASSERT_NO_FATAL_FAILURE(open(joined, folder / "a.Stl", true));
    expect_same_shape(*joined.mesh, mesh, 0.0f);
}

// assimp refuses files without triangles; what they are to look like is written here.
TEST(MeshFile, AMeshWithoutTrianglesIsAValidFileWithNone) {
    const TemporaryFolder folder;
    for (const char* name : {"a.ply", "a.obj", "a.stl"}) write_mesh(folder / name, SurfaceMesh{});
    const std::string ply = bytes_of(folder / "a.ply"), obj = bytes_of(folder / "a.obj");
    EXPECT_THAT(ply, AllOf(::testing::StartsWith("ply\nformat binary_little_endian 1.0\n"),
                           HasSubstr("element vertex 0\n"), HasSubstr("element face 0\n"),
                           ::testing::EndsWith("end_header\n")));
    EXPECT_EQ(obj, "# Touchstone, metres\n");
    const std::string stl = bytes_of(folder / "a.stl");
    ASSERT_EQ(stl.size(), 84u);
    EXPECT_EQ(stl.substr(80), std::string(4, '\0'));
}

TEST(MeshFile, OtherEndingsAreRefusedAndNothingIsWritten) {
    const TemporaryFolder folder;
    const auto names_the_three = AllOf(HasSubstr(".ply"), HasSubstr(".obj"), HasSubstr(".stl"));
    for (const char* name : {"a.gltf", "a", "ply", "a.ply.gz", ".ply"}) {
        expect_error([&] { check_mesh_ending(folder / name); }, ExitStatus::usage, names_the_three);
        expect_error([&] { write_mesh(folder / name, SurfaceMesh{}); }, ExitStatus::usage, names_the_three);
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    for (const char* name : {"a.ply", "a.OBJ", "b.c.Stl"}) EXPECT_NO_THROW(check_mesh_ending(folder / name));
}

TEST(MeshFile, AFolderThatIsNotThereIsAnIoError) {
    const TemporaryFolder folder;
    expect_error([&] { write_mesh(folder / "no/a.ply", SurfaceMesh{}); }, ExitStatus::io_error,
                 HasSubstr("a.ply"));
}

}  // namespace
}  // namespace touchstone
