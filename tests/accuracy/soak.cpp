// soak PROGRAM [--minutes N] [--plot FILE.png]: the table for hours at live pace, with visitors who come and
// go and a camera that fails, against the truth.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/core.h>

#include "tests/accuracy/soak_run.hpp"
#include "tests/support/gnuplot.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

int run(int argc, char** argv) {
    CLI::App app("Runs a simulated table for a long time and says how it did.");
    SoakRun run;
    double hours = 0.0;
    std::string plot;
    app.add_option("PROGRAM", run.program, "touchstone")->required()->check(CLI::ExistingFile);
    app.add_option("--minutes", run.minutes, "how long")->check(CLI::PositiveNumber);
    app.add_option("--hours", hours, "how long")->check(CLI::PositiveNumber);
    app.add_option("--scene", run.scene, "flat, curved, cluttered, bowl or mixed");
    app.add_option("--config", run.config, "of the program")->check(CLI::ExistingFile);
    app.add_option("--seed", run.seed, "of table, visitors and faults; those up to 50 are for tuning");
    app.add_option("--pause", run.pause_s, "seconds between two visits of a hand")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--faults-every", run.faults_every_s, "seconds; 0: the camera never fails")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--plot", plot, "chart of rate, lag, memory and open files, PNG; needs gnuplot");
    CLI11_PARSE(app, argc, argv);
    if (hours > 0.0) run.minutes = 60.0 * hours;
    run.shows_progress = isatty(fileno(stderr)) != 0;
    const SoakScore score = run_soak(run);
    fmt::print("{}", text_of(score));
    if (!plot.empty()) test::run_gnuplot(gnuplot_script(score, plot));
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) { return touchstone::test::run_main("soak", touchstone::run, argc, argv); }
