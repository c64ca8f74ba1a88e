#include "platform/openni2_drivers/simulator/object_mesh.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/mesh_distance.hpp"
#include "tests/platform/openni2_drivers/simulator/closed_mesh.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Eigen::AlignedBox3f box_of(const TriangleMesh& mesh) {
    Eigen::AlignedBox3f box;
    for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
    return box;
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

TEST(ObjectMesh, TheBowlIsAClosedBodyWithAWallOfSixMillimetres) {
    const TriangleMesh bowl = make_bowl();
    EXPECT_TRUE(is_closed(bowl));
    // Between half ellipsoids of 125 x 80 mm and 119 x 74 mm there are 423 cm3; foot and lip add 51.
    EXPECT_NEAR(volume_m3(bowl), 0.474e-3, 0.012e-3);
    const MeshDistance distance(bowl);
    for (const double angle : {0.3, 0.7, 1.2}) {
        // Half way between the ellipses there are 3 mm to either side.
        const Eigen::Vector3d in_wall(0.122 * std::cos(angle), -0.077 * std::sin(angle), 0.0);
        EXPECT_NEAR(distance.distance_m(in_wall), 0.003, 0.0005) << angle;
    }
    EXPECT_GT(distance.distance_m({0.0, 0.0, 0.0}), 0.07) << "open at +y";
}

TEST(ObjectMesh, FitMovesTheMiddleToTheOriginAndScalesTheLongestSide) {
    TriangleMesh mesh;
    add_box(mesh, upright({5.0F, 6.0F, 7.0F}, 0.0F), {1.0F, 2.0F, 0.5F}, Vec3::Ones());
    mesh.vertices.emplace_back(100.0F, 0.0F, 0.0F);  // of no triangle
    fit(mesh, 0.3);
    mesh.vertices.pop_back();
    EXPECT_LT((box_of(mesh).max() - Vec3(0.075F, 0.15F, 0.0375F)).norm(), 1e-6F);
    EXPECT_LT((box_of(mesh).min() + Vec3(0.075F, 0.15F, 0.0375F)).norm(), 1e-6F);
}

TEST(ObjectMesh, ReadsAnObjAndWeldsItsCorners) {
    const TemporaryFolder folder;
    // A pyramid whose corners have a normal for each face, a quad among the faces.
    write(folder / "pyramid.obj",
          "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 3\nvn 0 0 -1\nvn 0 -1 0\nvn 1 0 0\nvn 0 1 0\nvn -1 0 0\n"
          "f 4//1 3//1 2//1 1//1\nf 1//2 2//2 5//2\nf 2//3 3//3 5//3\nf 3//4 4//4 5//4\nf 4//5 1//5 5//5\n");
    const TriangleMesh mesh = read_mesh(folder / "pyramid.obj");
    EXPECT_EQ(mesh.vertices.size(), 5U);
    EXPECT_EQ(mesh.triangles.size(), 6U);
    EXPECT_EQ(mesh.albedo.size(), 6U);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume_m3(mesh), 4.0, 1e-6);
}

TEST(ObjectMesh, RefusalsNameTheFileAndTheReason) {
    const TemporaryFolder folder;
    const std::string missing = folder / "none.obj";
    expect_error([&] { read_mesh(missing); }, ExitStatus::no_input, HasSubstr(missing));
    const auto refused = [&](const std::string& name, const std::string& text, const std::string& reason) {
        write(folder / name, text);
        const std::string path = folder / name;
        expect_error([&] { read_mesh(path); }, ExitStatus::bad_data,
                     AllOf(HasSubstr(path), HasSubstr(reason)));
    };
    refused("empty.obj", "", "");
    refused("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n", "");
    refused("noise.obj", "\x7f\x45\x4c\x46 garbage \x01\x02\n\n\xff", "");
    refused("unknown.xyzzy", "v 0 0 0\n", "");
    refused("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "");
    expect_error([&] { read_mesh(folder.path()); }, ExitStatus::bad_data, HasSubstr("is not a file"));
    TriangleMesh point;
    point.vertices.assign(3, Vec3::Ones());
    point.triangles.push_back({0, 1, 2});
    expect_error([&] { fit(point, 0.2); }, ExitStatus::bad_data, HasSubstr("one point"));
}

TEST(ObjectMesh, ReadsWellKnownMeshes) {
    for (const std::string name : {"spot.obj", "stanford-bunny.obj"}) {
        const std::filesystem::path path =
            std::filesystem::path(TOUCHSTONE_SHARED_DIR) / "data/meshes" / name;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
        TriangleMesh mesh = read_mesh(path);
        fit(mesh, 0.25);
        EXPECT_GT(mesh.triangles.size(), 5000U);
        EXPECT_LT(mesh.vertices.size(), mesh.triangles.size()) << "corners are welded";
        EXPECT_NEAR(box_of(mesh).sizes().maxCoeff(), 0.25F, 1e-6F);
        EXPECT_LT(box_of(mesh).center().norm(), 1e-6F);
    }
}

}  // namespace
}  // namespace touchstone::sim
