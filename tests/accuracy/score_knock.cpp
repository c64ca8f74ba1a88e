// score_knock [FIRST_SEED [SEEDS [HANDS]]]: simulated tables whose camera is knocked, one line a run. Seeds 1
// to 5 where nothing else is said; those up to 50 are for tuning.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "tests/accuracy/knock_run.hpp"

namespace touchstone {
namespace {

std::string text(const std::optional<int>& frames) { return frames ? std::to_string(*frames) : "never"; }

void print_row(const KnockRun& run, const KnockScore& score) {
    std::printf(
        "| %s %d | %.1f deg %.0f mm | %s | %s | %.1f | %.2f | %.2f | %d | %d | %d | %d | %.0f | %.2f |\n",
        run.scene.c_str(), run.seed, static_cast<double>(run.knock_deg), static_cast<double>(run.knock_mm),
        text(score.frames_to_notice).c_str(), text(score.frames_to_live).c_str(),
        static_cast<double>(score.error.shift_mm), static_cast<double>(score.error.turn_deg),
        static_cast<double>(score.error.surface_mm), score.frozen_reports + score.open_touches,
        score.early_downs, score.false_alarms, score.scans_anew, score.slowest_ms, score.mean_watch_ms);
    std::fflush(stdout);
}

void score_all(int first_seed, int seeds, int hands) {
    const Device device{DeviceConfig{}};
    std::printf(
        "| scene, seed | knock | frames until noticed | until live | error mm | deg | surface mm | frozen "
        "reports "
        "| early downs | false alarms | scans anew | slowest ms | watch ms |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string scene : {"flat", "curved", "cluttered", "bowl", "mixed"}) {
        for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
            for (const auto& [deg, mm] :
                 {std::pair{0.5f, 5.0f}, {2.0f, 0.0f}, {0.0f, 50.0f}, {5.0f, 0.0f}, {5.0f, 50.0f}}) {
                const KnockRun run{scene, seed, hands, deg, mm};
                print_row(run, run_knock(device, run));
            }
        }
    }
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) try {
    const auto argument = [&](int at, int otherwise) { return argc > at ? std::atoi(argv[at]) : otherwise; };
    touchstone::score_all(argument(1, 1), argument(2, 5), argument(3, 0));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "score_knock: %s\n", error.what());
    return 65;
}
