// score_tables PROGRAM [FRAMES [FIRST_SEED [SEEDS]]]: two hands on every simulated table, scored, one line a
// run and the whole as a table. 1800 frames (60 s) from seed 101 where nothing else is said; lower seeds are
// for tuning.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>

#include "tests/accuracy/scored_run.hpp"

namespace {

void print_row(const std::string& scene, int seed, const touchstone::TouchScore& score) {
    const auto& position_mm = score.position_mm;
    const double sum_mm = std::accumulate(position_mm.begin(), position_mm.end(), 0.0);
    const double mean_mm = position_mm.empty() ? 0.0 : sum_mm / static_cast<double>(position_mm.size());
    std::printf("| %s %d | %d / %d (%.1f %%) | %d / %d | %.1f | %.2f | %d |\n", scene.c_str(), seed,
                score.of_two_and_more.found, score.of_two_and_more.contacts,
                100.0 * score.of_two_and_more.rate(), score.all.found, score.all.contacts,
                score.spurious_ids / score.minutes(), mean_mm, score.id_switches);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fprintf(stderr, "usage: score_tables PROGRAM [FRAMES [FIRST_SEED [SEEDS]]]\n");
        return 64;
    }
    const int frames = argc > 2 ? std::atoi(argv[2]) : 1800;
    const int first_seed = argc > 3 ? std::atoi(argv[3]) : 101;
    const int seeds = argc > 4 ? std::atoi(argv[4]) : 1;
    std::printf(
        "| scene, seed | contacts of 2 frames or more | all contacts | spurious a minute | position mm | id "
        "switches |\n");
    std::printf("|---|---|---|---|---|---|\n");
    for (const std::string scene : {"flat", "curved", "cluttered", "bowl"}) {
        for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
            const touchstone::TouchScore score = touchstone::scored_run(argv[1], scene, seed, frames);
            print_row(scene, seed, score);
            std::fprintf(stderr, "%s %d: %s\n", scene.c_str(), seed, touchstone::line_of(score).c_str());
        }
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "score_tables: %s\n", error.what());
    return 65;
}
