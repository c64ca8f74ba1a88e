// score_surface MESH TRUTH: the figures as JSON on standard output, a line for people on standard error.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <sstream>

#include "platform/system/error.hpp"
#include "tests/accuracy/mesh_input.hpp"
#include "tests/accuracy/surface_score.hpp"

namespace touchstone {
namespace {

/// The first pose of a TUM trajectory: lines of timestamp, place, quaternion x y z w; # starts a comment.
Eigen::Isometry3f first_pose(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw Error(ExitStatus::no_input, path + ": no such file; give a trajectory in TUM's format");
    std::string line;
    while (std::getline(file, line) && (line.empty() || line[0] == '#')) {
    }
    std::istringstream numbers(line);
    double timestamp = 0.0;
    Eigen::Vector3f place;
    Eigen::Quaternionf q;
    numbers >> timestamp >> place.x() >> place.y() >> place.z() >> q.x() >> q.y() >> q.z() >> q.w();
    if (!numbers || q.norm() < 0.5f) {
        throw Error(ExitStatus::bad_data, path + ": its first line is not: timestamp x y z qx qy qz qw");
    }
    return Eigen::Translation3f(place) * Eigen::Isometry3f(q.normalized());
}

int score(int argc, char** argv) {
    CLI::App app("Compares a reconstructed surface with the true one.");
    std::string mesh_path, truth_path, mesh_poses, truth_poses;
    float truth_scale = 1.0f;
    std::size_t samples = 200'000;
    bool align = false;
    app.add_option("MESH", mesh_path, "the reconstruction: PLY, OBJ or STL, metres")->required();
    app.add_option("TRUTH", truth_path, "the true surface")->required();
    app.add_option("--truth-scale", truth_scale, "metres per unit of TRUTH")->check(CLI::PositiveNumber);
    auto* from =
        app.add_option("--poses", mesh_poses,
                       "trajectory in the mesh's frame (TUM); its first pose is that of --truth-poses");
    auto* to = app.add_option("--truth-poses", truth_poses, "trajectory in the truth's frame");
    from->needs(to);
    to->needs(from);
    app.add_flag("--align", align, "then lay the mesh on the truth by ICP");
    app.add_option("--samples", samples, "points on each surface")->check(CLI::Range(100, 10'000'000));
    CLI11_PARSE(app, argc, argv);
    const SurfaceMesh mesh = read_mesh(mesh_path), truth = read_mesh(truth_path, truth_scale);
    Eigen::Isometry3f T_truth_mesh = Eigen::Isometry3f::Identity();
    if (*from) T_truth_mesh = first_pose(truth_poses) * first_pose(mesh_poses).inverse();
    if (align) T_truth_mesh = align_to_truth(mesh, truth, T_truth_mesh);
    const SurfaceScore result = score_surface(transformed(mesh, T_truth_mesh), truth, samples);
    std::cout << json_of(result) << '\n';
    std::cerr << line_of(result) << '\n';
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) try {
    return touchstone::score(argc, argv);
} catch (const touchstone::Error& error) {
    std::cerr << "score_surface: " << error.what() << '\n';
    return static_cast<int>(error.status());
}
