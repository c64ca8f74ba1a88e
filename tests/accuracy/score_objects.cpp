// score_objects [FIRST_SEED [SEEDS [CYCLES [PART]]]]: things put down and taken away by a simulated hand,
// things lifted out of the scanned scene, and hands in view during the scan; Kinect noise and drift. Seed 1
// and 50 cycles where nothing else is said; seeds up to 50 are for tuning. PART: put, lift, scan or all of
// them.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/accuracy/object_run.hpp"

namespace touchstone {
namespace {

void score_put_and_take(const Device& device, int first_seed, int seeds, int cycles) {
    std::printf(
        "| put down and taken: scene, seed | cycles | settled | taken | cut out wrongly | settled after s | "
        "back after s | bricks before, after | MB after the 5th, last | ghost mm | ghost vertices | stage ms "
        "median, 99 %% |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string scene : {"flat", "cluttered"}) {
        for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
            const PutAndTakeScore s = run_put_and_take(device, scene, seed, cycles);
            std::printf(
                "| %s %d | %d | %d | %d | %d | %.2f | %.2f | %d, %d | %.1f, %.1f | %.2f | %d | %.2f, %.2f "
                "|\n",
                scene.c_str(), seed, s.cycles, s.settled, s.taken, s.lifted, s.settle_s, s.back_s,
                s.bricks_before, s.bricks_after, s.megabytes_first, s.megabytes_last, s.ghost_mm,
                s.ghost_vertices, s.stage_ms, s.stage_p99_ms);
            std::fflush(stdout);
        }
    }
}

void score_lifts(const Device& device, int first_seed, int seeds) {
    std::printf(
        "\n| lifted out of the scan: scene, seed, thing | cut out | cuts | s after it left the view | IoU | "
        "mesh "
        "to truth mm | table to truth mm |\n|---|---|---|---|---|---|---|\n");
    for (const std::string scene : {"flat", "cluttered"}) {
        for (const std::string object : {"box", "ball", "can", "book"}) {
            for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
                const LiftScore s = run_lift(device, scene, seed, object);
                std::printf("| %s %d %s | %s | %d | %.2f | %.3f | %.2f | %.2f |\n", scene.c_str(), seed,
                            object.c_str(), s.lifted ? "yes" : "no", s.cuts, s.after_s, s.iou, s.surface_mm,
                            s.rest_mm);
                std::fflush(stdout);
            }
        }
    }
}

void score_movers(const Device& device, int first_seed, int seeds) {
    std::printf(
        "\n| scan with hands in view: scene, seed, hands | live after frames | too near %% of the picture | "
        "unknown %% |\n|---|---|---|---|\n");
    for (const std::string scene : {"flat", "cluttered"}) {
        for (int seed = first_seed; seed < first_seed + seeds; ++seed) {
            for (const int hands : {0, 1, 2}) {
                const MoverScore s = run_scan_with_mover(device, scene, seed, hands);
                std::printf("| %s %d %d | %d | %.3f | %.2f |\n", scene.c_str(), seed, hands,
                            s.live_after_frames, 100.0 * s.wrong_share, 100.0 * s.unknown_share);
                std::fflush(stdout);
            }
        }
    }
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) try {
    const auto argument = [&](int at, int otherwise) { return argc > at ? std::atoi(argv[at]) : otherwise; };
    const touchstone::Device device{touchstone::DeviceConfig{}};
    const int first_seed = argument(1, 1), seeds = argument(2, 1), cycles = argument(3, 50);
    const std::string part = argc > 4 ? argv[4] : "all";
    if (part == "all" || part == "put") touchstone::score_put_and_take(device, first_seed, seeds, cycles);
    if (part == "all" || part == "lift") touchstone::score_lifts(device, first_seed, seeds);
    if (part == "all" || part == "scan") touchstone::score_movers(device, first_seed, seeds);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "score_objects: %s\n", error.what());
    return 65;
}
