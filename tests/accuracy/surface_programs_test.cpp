#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/mesh_file.hpp"
#include "platform/image/png_file.hpp"
#include "tests/accuracy/surface_score.hpp"
#include "tests/support/distance_snapshot.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/small_volume.hpp"

namespace touchstone {
namespace {

using Command = std::vector<std::string>;

test::ProgramResult run(const Command& command) { return test::run_program(command); }

SurfaceMesh box_mesh() {
    const auto box = test::box_distance({0.3f, 0.32f, 0.33f}, {0.15f, 0.11f, 0.07f});
    return extract_surface(test::snapshot_of(test::small_volume(), box));
}

/// A trajectory of one pose, after a comment.
void write_pose(const std::filesystem::path& path, const Eigen::Isometry3f& T) {
    const Eigen::Quaternionf q(T.linear());
    const Eigen::Vector3f p = T.translation();
    std::ofstream file(path);
    file << "# timestamp x y z qx qy qz qw\n1.5 " << p.x() << ' ' << p.y() << ' ' << p.z() << ' ' << q.x()
         << ' ' << q.y() << ' ' << q.z() << ' ' << q.w() << '\n';
}

TEST(ScoreSurface, PosesSayHowTheFramesLie) {
    const TemporaryFolder folder;
    const SurfaceMesh truth = box_mesh();
    Eigen::Isometry3f T_truth_mesh(Eigen::Translation3f(0.5f, -0.2f, 0.1f)), T_mesh_c = T_truth_mesh;
    T_truth_mesh.rotate(Eigen::AngleAxisf(1.2f, Eigen::Vector3f(0.2f, 0.5f, -0.9f).normalized()));
    T_mesh_c.rotate(Eigen::AngleAxisf(-0.7f, Eigen::Vector3f::UnitX()));
    write_mesh(folder / "truth.obj", truth);
    write_mesh(folder / "mesh.ply", transformed(truth, T_truth_mesh.inverse()));
    write_pose(folder / "mesh.txt", T_mesh_c);
    write_pose(folder / "truth.txt", T_truth_mesh * T_mesh_c);
    const Command command = {TOUCHSTONE_SCORE_SURFACE, folder / "mesh.ply", folder / "truth.obj", "--samples",
                             "5000"};
    const auto off = nlohmann::json::parse(run(command).out);
    EXPECT_GT(off["accuracy"]["mean_mm"], 50.0);
    Command with_poses = command;
    with_poses.insert(with_poses.end(),
                      {"--poses", folder / "mesh.txt", "--truth-poses", folder / "truth.txt"});
    const auto scored = nlohmann::json::parse(run(with_poses).out);
    EXPECT_LT(scored["accuracy"]["mean_mm"], 0.01);
    EXPECT_EQ(scored["completeness"]["share_within_5_mm"], 1.0);
    write_pose(folder / "mesh.txt", T_mesh_c * Eigen::Translation3f(0.01f, 0.0f, 0.0f));
    EXPECT_GT(nlohmann::json::parse(run(with_poses).out)["accuracy"]["mean_mm"], 2.0);
    with_poses.push_back("--align");
    EXPECT_LT(nlohmann::json::parse(run(with_poses).out)["accuracy"]["mean_mm"], 0.05);
}

TEST(ScoreSurface, BadInputIsSaidInOneLine) {
    const TemporaryFolder folder;
    write_mesh(folder / "a.ply", box_mesh());
    std::ofstream(folder / "poses.txt") << "1.0 2.0 3.0\n";
    const auto no_mesh = run({TOUCHSTONE_SCORE_SURFACE, folder / "b.ply", folder / "a.ply"});
    EXPECT_EQ(no_mesh.status, 66);
    EXPECT_NE(no_mesh.err.find("b.ply"), std::string::npos);
    const auto bad_pose = run({TOUCHSTONE_SCORE_SURFACE, folder / "a.ply", folder / "a.ply", "--poses",
                               folder / "poses.txt", "--truth-poses", folder / "poses.txt"});
    EXPECT_EQ(bad_pose.status, 65);
    EXPECT_NE(bad_pose.err.find("poses.txt"), std::string::npos);
}

TEST(RenderMesh, WritesThePicture) {
    const TemporaryFolder folder;
    write_mesh(folder / "a.stl", box_mesh());
    const auto result = run({TOUCHSTONE_RENDER_MESH, folder / "a.stl", folder / "a.png", "--width", "320"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Image8 image = read_png_8(folder / "a.png");
    EXPECT_EQ(image.width_px, 320);
    EXPECT_EQ(image.height_px, 240);
    const auto centre = static_cast<std::size_t>(3 * (120 * 320 + 160));
    EXPECT_GT(image.pixels[centre], 60) << "the box is in the middle";
}

}  // namespace
}  // namespace touchstone
