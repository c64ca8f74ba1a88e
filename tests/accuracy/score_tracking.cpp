// score_tracking PROGRAM [CASE...]: runs `PROGRAM track` on recordings and simulations whose truth is known,
// and prints a line for each: path error, surface error, memory.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>

#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/system/error.hpp"
#include "tests/accuracy/mesh_input.hpp"
#include "tests/accuracy/path_score.hpp"
#include "tests/accuracy/surface_score.hpp"
#include "tests/accuracy/true_surface.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

struct Case {
    std::string name;
    std::string sequence;  ///< folder of the recordings, or empty
    std::string simulation;
    std::string options;
    bool scores_surface = false;
    bool aligns_surface = false;     ///< of an object that is turned: laid on its truth first
    std::string undisturbed = {};    ///< the same simulation with nothing that moves by itself, or empty
    std::string camera_matrix = {};  ///< instead of the sequence's own, or empty
};

std::vector<Case> all_cases(int seed, int frames) {
    const std::string tail = fmt::format("&seed={}", seed);
    const auto room = [&](const std::string& keys, int count) {
        return fmt::format("room?frames={}&{}{}", frames > 0 ? std::min(frames, count) : count, keys, tail);
    };
    const auto person = [&](const std::string& name, const std::string& who) {
        const std::string keys = "motion=sweep&noise=1&drift=0";
        return Case{name, "", room(keys + who, 300), "--side 3", true, false, room(keys, 300)};
    };
    const auto object = [&](const std::string& mesh) {
        return fmt::format("object?frames={}&grip=fingers&noise=1{}{}", frames > 0 ? frames : 643,
                           mesh.empty() ? "" : "&mesh=" + mesh, tail);
    };
    const std::string meshes = std::string(TOUCHSTONE_SHARED_DIR) + "/data/meshes/";
    return {
        {"kitchen", "redkitchen-000-299", "", "", false, false},
        {"desk", "tum-fr1-rpy-000-119", "", "", false, false},
        // What the authors of the dataset recommend for its depth, which OpenNI has registered already:
        // "the ROS default parameter set (i.e., without undistortion)".
        {"desk-ros", "tum-fr1-rpy-000-119", "", "", false, false, "", "525 0 319.5\n0 525 239.5\n0 0 1\n"},
        {"room", "", room("motion=sweep&noise=1&drift=0", 500), "--side 3", true, false},
        {"room-drift", "", room("motion=sweep&noise=1", 500), "--side 3", true, false},
        {"room-exact", "", room("motion=sweep&noise=0", 500), "--side 3", true, false},
        {"room-fast", "", room("motion=rpy&noise=1&drift=0", 300), "--side 3", false, false},
        person("room-comer20", "&person=0.2&person_s=1"),
        person("room-comer40", "&person=0.4&person_s=1"),
        person("room-person20", "&person=0.2"),
        person("room-person40", "&person=0.4"),
        {"still", "", room("motion=still&noise=1&drift=0", 1000), "--side 3", false, false},
        {"wall", "",
         fmt::format("wall?frames={}&motion=still&noise=1&drift=0{}", frames > 0 ? frames : 300, tail),
         "--side 3", false, false},
        {"bowl", "", object(""), "--side 0.32 --voxels 256", true, true},
        {"bunny", "", object(meshes + "stanford-bunny.obj"), "--side 0.32 --voxels 256", true, true},
        {"spot", "", object(meshes + "spot.obj"), "--side 0.32 --voxels 256", true, true}};
}

/// The sequence with another camera matrix, made of links in `folder`.
fs::path with_camera_matrix(const fs::path& sequence, const std::string& matrix, const fs::path& folder) {
    fs::create_directory(folder);
    for (const fs::directory_entry& entry : fs::directory_iterator(sequence)) {
        if (entry.path().filename() != "camera-intrinsics.txt")
            fs::create_symlink(fs::canonical(entry.path()), folder / entry.path().filename());
    }
    std::ofstream(folder / "camera-intrinsics.txt") << matrix;
    return folder;
}

/// What `track` made of one source.
struct Track {
    std::vector<TimedPose> estimate, truth;
    SurfaceMesh mesh;
    std::string summary;
};

Track track(const std::string& program, const Case& which, const std::string& simulation,
            const std::optional<fs::path>& meshes = {}) {
    const TemporaryFolder folder;
    const fs::path trajectory = folder.path() / "t", poses = folder.path() / "p";
    const fs::path mesh_file = meshes ? *meshes / (which.name + ".ply") : folder.path() / "m.ply";
    fs::path sequence = fs::path(TOUCHSTONE_SHARED_DIR) / "data" / which.sequence;
    if (!which.camera_matrix.empty())
        sequence = with_camera_matrix(sequence, which.camera_matrix, folder / "sequence");
    const std::string sensor =
        simulation.empty() ? "seq:" + sequence.string() : "sim:" + simulation + "&poses=" + poses.string();
    const std::string command = fmt::format(
        "'{}' track --pace step --sensor '{}' --trajectory {} --mesh {} {} 2>/dev/null > {}", program, sensor,
        trajectory.string(), mesh_file.string(), which.options, (folder.path() / "out").string());
    if (std::system(command.c_str()) != 0) throw Error(ExitStatus::unavailable, "failed: " + command);
    Track result{read_trajectory(trajectory),
                 simulation.empty() ? read_true_path(sequence) : read_trajectory(poses),
                 read_mesh(mesh_file),
                 {}};
    std::ifstream summary(folder.path() / "out");
    std::getline(summary, result.summary);
    return result;
}

void print_surface(const Case& which, const Track& found) {
    const SurfaceMesh surface = surface_of(truth_mesh(parse_simulator_uri(which.simulation)));
    Eigen::Isometry3f T = (found.truth.front().T_w_c * found.estimate.front().T_w_c.inverse()).cast<float>();
    if (which.aligns_surface) T = align_to_truth(found.mesh, surface, T);
    const SurfaceScore score = score_surface(transformed(found.mesh, T), surface);
    std::printf("            %s; %.2f %% over 50 mm off\n", line_of(score).c_str(),
                100.0 * score.share_over_50_mm);
}

void run_case(const std::string& program, const Case& which, const std::optional<fs::path>& meshes) {
    const fs::path sequence = fs::path(TOUCHSTONE_SHARED_DIR) / "data" / which.sequence;
    if (!which.sequence.empty() && !fs::exists(sequence)) {
        std::printf("%-11s skipped: %s is not there\n", which.name.c_str(), sequence.c_str());
        return;
    }
    const Track found = track(program, which, which.simulation, meshes);
    const PathScore path = score_path(found.estimate, found.truth);
    std::printf(
        "%-11s %4zu tracked, ATE %.2f mm, largest %.2f mm; drift from the first pose at most %.2f mm, %.3f "
        "deg\n            %s\n",
        which.name.c_str(), path.matched, path.ate_rmse_mm, path.ate_max_mm, path.drift_mm, path.drift_deg,
        found.summary.substr(0, found.summary.rfind(';')).c_str());
    if (!which.undisturbed.empty()) {
        const Track alone = track(program, which, which.undisturbed);
        const double ate_mm = score_path(alone.estimate, alone.truth).ate_rmse_mm;
        std::printf("            ATE %.2f mm with nothing that moves by itself: %.2f times as much\n", ate_mm,
                    path.ate_rmse_mm / ate_mm);
    }
    if (which.scores_surface) print_surface(which, found);
    std::fflush(stdout);
}

int score(int argc, char** argv) {
    CLI::App app("Scores paths and surfaces of `touchstone track` against the truth.");
    std::string program;
    std::vector<std::string> names;
    int seed = 1, frames = 0;
    std::optional<fs::path> meshes;
    app.add_option("PROGRAM", program, "touchstone")->required();
    app.add_option(
        "CASE", names,
        "kitchen, desk, desk-ros (another camera matrix), room, room-drift (column bands shift while the "
        "camera moves), room-exact, "
        "room-fast, room-comer20, room-comer40 (somebody comes in and covers so much of the picture), "
        "room-person20, room-person40 (they are there from the first frame), still, wall, "
        "bowl, bunny, spot; all by default");
    app.add_option("--seed", seed, "of the simulations; up to 50 for tuning, above 100 for scores");
    app.add_option("--frames", frames, "at most, of simulations");
    app.add_option("--meshes", meshes, "folder where the meshes are kept");
    CLI11_PARSE(app, argc, argv);
    for (const Case& which : all_cases(seed, frames))
        if (names.empty() || std::ranges::find(names, which.name) != names.end())
            run_case(program, which, meshes);
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    try {
        return touchstone::score(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "score_tracking: %s\n", error.what());
        return 1;
    }
}
