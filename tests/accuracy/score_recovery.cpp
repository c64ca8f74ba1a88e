// score_recovery PROGRAM: a simulated camera that fails at random, again and again, in one run of the
// program.
#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "tests/accuracy/recovery_run.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

int run(int argc, char** argv) {
    CLI::App app("Lives through random faults of a simulated camera.");
    RecoveryRun run;
    app.add_option("PROGRAM", run.program, "touchstone")->required()->check(CLI::ExistingFile);
    app.add_option("--faults", run.faults, "before it ends")->check(CLI::PositiveNumber);
    app.add_option("--hands", run.hands, "0: every touch is a ghost")->check(CLI::Range(0, 2));
    app.add_option("--seed", run.seed, "of scene and faults; those up to 50 are for tuning");
    CLI11_PARSE(app, argc, argv);
    const RecoveryScore score = run_recovery(run);
    fmt::print("faults {} in {:.0f} s ({} frames), {} restarts of stream or camera, exit status {}\n",
               score.faults, score.seconds, score.frames, score.restarts, score.exit_status);
    fmt::print("longest time without a frame {:.2f} s, of which an unplugged camera is away {:.1f} s\n",
               score.longest_gap_s, run.fault_s);
    fmt::print("touches: {} down, {} left behind, {} events out of order\n", score.downs, score.left_touches,
               score.confused_events);
    fmt::print("memory {:.1f} -> {:.1f} MB, open files {} -> {}\n", score.early_mb, score.late_mb,
               score.early_files, score.late_files);
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("score_recovery", touchstone::run, argc, argv);
}
