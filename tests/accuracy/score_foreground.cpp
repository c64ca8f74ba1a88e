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

void print_row(const char* what, const ForegroundRun& run, const SurfaceErrors& raw,
               const SurfaceErrors& filtered, const SurfaceErrors& shown, const ForegroundScore& score) {
    std::printf(
        "| %s %d, %s | %.2f / %.2f / %.2f | %.2f | %.2f / %.2f / %.2f | %.2f / %.2f / %.2f | %.0f | %d / %d "
        "| "
        "%.1f (%.1f) of %.1f |\n",
        run.scene.c_str(), run.seed, what, raw.noise_mm(), filtered.noise_mm(), shown.noise_mm(),
        raw.noise_mm() / shown.noise_mm(), raw.mean_mm(), filtered.mean_mm(), shown.mean_mm(),
        score.raw_lag.lag_frames(), score.shown_lag.lag_frames(), score.model_lag.lag_frames(),
        100.0 * score.modelled_share, score.volumes_made, score.hand_visits, score.median_ms, score.p99_ms,
        score.frame_median_ms);
    std::fflush(stdout);
}

void print_run(const ForegroundRun& run) {
    const ForegroundScore score = score_foreground(run);
    print_row("all", run, score.raw, score.filtered, score.shown, score);
    print_row("moving", run, score.raw_moving, score.filtered_moving, score.shown_moving, score);
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) try {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 600;
    const int first_seed = argc > 2 ? std::atoi(argv[2]) : 1;
    const int seeds = argc > 3 ? std::atoi(argv[3]) : 1;
    std::printf(
        "| scene, seed, hands | noise mm raw / filtered / shown | raw / shown | mean error mm | finger's "
        "lag, frames: "
        "raw / shown / volumes alone | modelled %% | volumes / visits | stage ms median (99 %%) of frame |\n"
        "|---|---|---|---|---|---|---|---|\n");
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
