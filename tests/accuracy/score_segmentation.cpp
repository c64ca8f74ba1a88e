// score_segmentation PROGRAM [CASE...]: foreground masks of simulated tables and of two recordings against
// their truth, one row of a table each, with the bar.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <numeric>

#include "platform/system/percentile.hpp"
#include "tests/accuracy/mask_run.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string program;
    std::vector<std::string> cases{"flat", "curved", "cluttered", "table", "room"};
    int seed = 101, seeds = 1, frames = 900;
    std::string pictures;
};

void print_row(const std::string& name, const std::string& bar, const std::string& figure, bool met) {
    std::printf("| %s | %s | %s | %s |\n", name.c_str(), bar.c_str(), figure.c_str(), met ? "met" : "missed");
    std::fflush(stdout);
}

void score_simulation(const Options& options, const std::string& scene, int seed) {
    const MaskScore score = scored_simulation(options.program, scene, seed, options.frames, options.pictures);
    const double median = percentile(score.overlap, 50.0), tenth = percentile(score.overlap, 10.0);
    const double false_sum = std::accumulate(score.false_area.begin(), score.false_area.end(), 0.0);
    const double false_area =
        false_sum / static_cast<double>(std::max<std::size_t>(1, score.false_area.size()));
    const double most_false = percentile(score.false_area, 100.0);
    print_row(
        fmt::format("{} {}", scene, seed), "IoU 0.90, 10th percentile 0.80, false 0.1 %",
        fmt::format("{:.3f}, {:.3f} over {} frames; {:.3f} % (most {:.3f} %) over {} empty", median, tenth,
                    score.overlap.size(), 100.0 * false_area, 100.0 * most_false, score.false_area.size()),
        median > 0.90 && tenth > 0.80 && false_area < 0.001 && score.missing == 0);
}

void score_table(const Options& options, const fs::path& table) {
    const std::vector<MaskFrame> frames = scored_table(options.program, table, options.pictures);
    std::vector<double> ious;
    const MaskFrame* worst = &frames.front();
    for (const MaskFrame& frame : frames) {
        ious.push_back(frame.iou());
        if (frame.iou() < worst->iou()) worst = &frame;
        std::fprintf(stderr, "%s: IoU %.4f, missed %ld, too many %ld of %ld\n", frame.name.c_str(),
                     frame.iou(), frame.truth - frame.both, frame.marked - frame.both, frame.truth);
    }
    print_row(
        "labelled table, 16 scenes", "IoU 0.97 each",
        fmt::format("least {:.3f} ({}), median {:.3f}", worst->iou(), worst->name, percentile(ious, 50.0)),
        worst->iou() >= 0.97);
}

double most_marked(const std::vector<MaskFrame>& frames) {
    double most = 0.0;
    for (const MaskFrame& frame : frames) most = std::max(most, frame.marked_share());
    return most;
}

void score_room(const Options& options, const fs::path& room) {
    const RoomScore score = scored_room(options.program, room, options.pictures);
    const double before = most_marked(score.before), after = most_marked(score.after);
    print_row("real room, frames 0-19", "0.1 % marked", fmt::format("at most {:.3f} %", 100.0 * before),
              before < 0.001);
    print_row("real room, frames 330-345", "0.1 % marked",
              fmt::format("at most {:.3f} % (with the person at least {:.1f} %)", 100.0 * after,
                          100.0 * score.least_person),
              after < 0.001);
}

void score_recording(const Options& options, const std::string& name) {
    const bool is_table = name == "table";
    const fs::path folder =
        fs::path(TOUCHSTONE_SHARED_DIR) / "data" / (is_table ? "table-fixed-camera-a" : "kinect-room-person");
    if (!fs::exists(folder))
        std::printf("| %s | | skipped: %s is not there | |\n", name.c_str(), folder.c_str());
    else if (is_table)
        score_table(options, folder);
    else
        score_room(options, folder);
}

int score(int argc, char** argv) {
    CLI::App app("Scores foreground masks against the truth.");
    Options options;
    app.add_option("PROGRAM", options.program, "touchstone")->required();
    app.add_option("CASE", options.cases, "flat, curved, cluttered (simulated), table, room (recordings)");
    app.add_option("--seed", options.seed,
                   "first of the simulations; up to 50 for tuning, above 100 for scores");
    app.add_option("--seeds", options.seeds, "how many")->check(CLI::PositiveNumber);
    app.add_option("--frames", options.frames, "of each simulation")->check(CLI::Range(90, 100'000));
    app.add_option(
        "--pictures", options.pictures,
        "folder for pictures: green agreed, blue missed, red too many; of simulations the worst frames");
    CLI11_PARSE(app, argc, argv);
    std::printf("| case | bar | figure | |\n|---|---|---|---|\n");
    for (const std::string& name : options.cases) {
        if (name == "table" || name == "room") {
            score_recording(options, name);
            continue;
        }
        for (int seed = options.seed; seed < options.seed + options.seeds; ++seed)
            score_simulation(options, name, seed);
    }
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("score_segmentation", touchstone::score, argc, argv);
}
