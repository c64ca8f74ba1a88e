// score_foreground [FRAMES [FIRST_SEED [SEEDS [SCENE]]]]: two hands on simulated tables; the foreground's
// surface against the exact hands, one line a run. 600 frames from seed 1 where nothing else is said; seeds
// up to 50 are for tuning.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/accuracy/foreground_score.hpp"

namespace touchstone {
namespace {

void print_row(const ForegroundRun& run, const char* what, const ForegroundScore::Errors& errors) {
    std::printf("| %s %d, %s | %.2f / %.2f / %.2f | %.2f | %.2f / %.2f / %.2f |\n", run.scene.c_str(),
                run.seed, what, errors.raw.noise_mm(), errors.filtered.noise_mm(), errors.shown.noise_mm(),
                errors.raw.noise_mm() / errors.shown.noise_mm(), errors.raw.mean_mm(),
                errors.filtered.mean_mm(), errors.shown.mean_mm());
}

void print_run(const ForegroundRun& run) {
    const ForegroundScore score = score_foreground(run);
    print_row(run, "moving arms", score.moving_arms);
    print_row(run, "moving hands", score.moving_hands);
    print_row(run, "still arms", score.still_arms);
    print_row(run, "still hands", score.still_hands);
    std::printf(
        "%s %d: a finger's lag in frames: raw %.2f, shown %.2f, volumes alone %.2f (%zu frames); %.0f %% of "
        "the "
        "foreground from volumes, %d volumes in %d visits; stage %.1f ms (99 %% %.1f) of a frame's %.1f\n",
        run.scene.c_str(), run.seed, score.raw_lag.lag_frames(), score.shown_lag.lag_frames(),
        score.model_lag.lag_frames(), score.model_lag.frames(), 100.0 * score.modelled_share,
        score.volumes_made, score.hand_visits, score.median_ms, score.p99_ms, score.frame_median_ms);
    std::fflush(stdout);
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) try {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 600;
    const int first_seed = argc > 2 ? std::atoi(argv[2]) : 1;
    const int seeds = argc > 3 ? std::atoi(argv[3]) : 1;
    std::printf(
        "| scene, seed | noise mm: raw / filtered / shown | raw / shown | mean error mm: raw / filtered / "
        "shown |\n"
        "|---|---|---|---|\n");
    std::vector<std::string> scenes{"flat", "curved", "cluttered"};
    if (argc > 4) scenes = {argv[4]};
    for (const std::string& scene : scenes) {
        for (int seed = first_seed; seed < first_seed + seeds; ++seed)
            touchstone::print_run({scene, seed, frames});
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "score_foreground: %s\n", error.what());
    return 65;
}
