// score_projector PROGRAM [flat|curved|bowl...]: calibrates the simulated projector and measures where its
// light falls; one row of a table each.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/accuracy/projector_run.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

void print_row(const ProjectorRun& run, const ProjectorScore& score) {
    std::printf("| %s %d | %s | %s | %.2f | %d | %d | %.2f | %.2f | %d | %.2f | %.2f |\n", run.scene.c_str(),
                run.seed, run.method.c_str(), score.model.c_str(), score.rms_px, score.points, score.frames,
                score.mean_mm, score.p95_mm, score.touches, score.touch_mean_mm, score.touch_p95_mm);
    std::fflush(stdout);
}

int score(int argc, char** argv) {
    CLI::App app(
        "Scores the calibration of a projector: bars 1.5 pixels RMS, 20 s of camera frames; fingers on what "
        "is "
        "drawn 4 mm on flat, 6 mm on ridge and bowl.");
    std::vector<std::string> scenes{"flat", "curved", "bowl"}, methods{"graycode", "touch"};
    ProjectorRun run;
    run.seed = 101;
    app.add_option("PROGRAM", run.program, "build/release/touchstone")->required();
    app.add_option("SCENE", scenes, "flat, curved, bowl, cluttered, mixed");
    app.add_option("--method", methods, "graycode, touch");
    app.add_option("--seed", run.seed, "up to 50 for tuning, above 100 for scores");
    app.add_option("--touch-frames", run.touch_frames, "of the run with fingers, 0: none");
    app.add_option("--pictures", run.pictures, "folder for what is thrown and what the camera sees of it");
    app.add_option("--keys", run.keys, "more keys of the simulator for the calibration: &ambient=0.6");
    CLI11_PARSE(app, argc, argv);
    std::printf(
        "| scene, seed | method | model | RMS px | points | frames | light off, mean mm | 95 %% | touches | "
        "finger to its light, mean mm | 95 %% |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& scene : scenes) {
        for (const std::string& method : methods) {
            run.scene = scene;
            run.method = method;
            print_row(run, run_projector(run));
        }
    }
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("score_projector", touchstone::score, argc, argv);
}
