#include "platform/mesh/mesh_file.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

class MeshFileTest : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& content) {
        const std::filesystem::path path = folder_.path() / name;
        std::ofstream(path, std::ios::binary) << content;
        return path;
    }
    TemporaryFolder folder_;
};

constexpr const char* square_obj =
    "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n";

/// A triangle whose corners (36 bytes) and indices (6 bytes) lie in the file itself, red by its material.
constexpr const char* triangle_gltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":1},"indices":0,"material":0}]}],
"buffers":[{"byteLength":44,"uri":"data:application/octet-stream;base64,AAABAAIAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAA="}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":6},{"buffer":0,"byteOffset":8,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5123,"count":3,"type":"SCALAR"},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3","max":[1,1,0],"min":[0,0,0]}]})";

TEST_F(MeshFileTest, ObjHasItsCornersNormalsAndTheColourOfClay) {
    const MeshFile mesh = read_mesh_file(write("square.obj", square_obj), MeshDetail::look);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    ASSERT_EQ(mesh.positions.size(), 4u);
    ASSERT_EQ(mesh.normals.size(), 4u);
    for (const Eigen::Vector3f& n : mesh.normals) EXPECT_LT((n - Eigen::Vector3f::UnitY()).norm(), 1e-5f);
    EXPECT_EQ(mesh.colors.size(), 4u);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const Eigen::Vector3f& p : mesh.positions) sum += p;
    EXPECT_LT((sum - Eigen::Vector3f(2.0f, 0.0f, 2.0f)).norm(), 1e-5f);
}

TEST_F(MeshFileTest, TheShapeAloneHasNeither) {
    const MeshFile mesh = read_mesh_file(write("square.obj", square_obj), MeshDetail::shape);
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(mesh.colors.empty());
}

TEST_F(MeshFileTest, GltfHasItsMaterialsColourAndNormalsAreMade) {
    const MeshFile mesh = read_mesh_file(write("triangle.gltf", triangle_gltf), MeshDetail::look);
    ASSERT_EQ(mesh.triangles.size(), 1u);
    ASSERT_EQ(mesh.positions.size(), 3u);
    for (const auto& color : mesh.colors) EXPECT_EQ(color, (std::array<std::uint8_t, 4>{255, 0, 0, 255}));
    for (const Eigen::Vector3f& n : mesh.normals) EXPECT_NEAR(std::abs(n.z()), 1.0f, 1e-5f);
}

TEST_F(MeshFileTest, WhatIsNoMeshIsNamed) {
    const std::string missing = folder_.path() / "missing.obj";
    expect_error([&] { read_mesh_file(missing, MeshDetail::look); }, ExitStatus::no_input,
                 HasSubstr(missing));
    expect_error([&] { read_mesh_file(folder_.path(), MeshDetail::look); }, ExitStatus::bad_data,
                 HasSubstr("is not a file"));
    for (const auto& [name, content] :
         {std::pair("empty.obj", ""), std::pair("points.obj", "v 0 0 0\nv 1 0 0\n"),
          std::pair("noise.gltf", "{\"asset\": 17"), std::pair("text.obj", "this is no mesh\n"),
          std::pair("kind.xyz", "1 2 3\n"),
          std::pair("not_a_number.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}) {
        const std::filesystem::path path = write(name, content);
        expect_error([&] { read_mesh_file(path, MeshDetail::look); }, ExitStatus::bad_data, HasSubstr(name));
    }
}

TEST_F(MeshFileTest, AHugeFileIsRefusedUnread) {
    const std::filesystem::path path = write("huge.obj", square_obj);
    std::filesystem::resize_file(path, 65U << 20);
    expect_error([&] { read_mesh_file(path, MeshDetail::look); }, ExitStatus::bad_data,
                 HasSubstr("larger than 64 MiB"));
}

}  // namespace
}  // namespace touchstone
