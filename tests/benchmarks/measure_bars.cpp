// The figures that the product is held to, measured and printed: measure_bars PROGRAM [--only GROUP...].
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <functional>

#include "tests/benchmarks/bench_stage.hpp"
#include "tests/benchmarks/brick_volume.hpp"
#include "tests/benchmarks/busy_neighbour.hpp"
#include "tests/benchmarks/dense_yardstick.hpp"
#include "tests/benchmarks/in_turns.hpp"
#include "tests/benchmarks/program_runs.hpp"
#include "tests/support/program_main.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

constexpr int size_vox = 512;

struct Options {
    std::string program;
    std::vector<std::string> only;
    std::filesystem::path sequence;
    int rounds = 7;
};

void print_bar(const std::string& what, double value, const std::string& unit, double bar, bool at_least) {
    const bool met = at_least ? value >= bar : value <= bar;
    fmt::print("{:<62} {:>8.2f} {:<3} bar {} {:<6g} {}\n", what, value, unit, at_least ? ">=" : "<=", bar,
               met ? "met" : "MISSED");
    std::fflush(stdout);
}

void print_ratio(const std::string& what, const Turns& turns, double bar) {
    print_bar(fmt::format("{}: {:.1f} / {:.1f} ms", what, turns.first_median_ms(), turns.second_median_ms()),
              turns.median_ratio(), "x", bar, true);
    fmt::print("    of the shortest times {:.2f}\n", turns.best_ratio());
}

/// Integration and raycast of the dense array and of bricks in turns; one frame of the simulator.
void measure_dense(const Options& options) {
    const Device device{DeviceConfig{}};
    const BenchStage stage(device, {});
    const RigidTransform T_g_c = stage.background().T_g_c();
    BrickVolume bricks(stage, size_vox);
    DenseVolume dense(device, stage.intrinsics(), size_vox, bench_side_m,
                      bricks.volume().params().max_truncation_m);
    SurfacePrediction prediction(device, stage.shape());
    print_ratio("integration 512, dense / bricks",
                measure_in_turns(
                    options.rounds, 1,
                    [&] {
                        dense.integrate(stage.live().depth_m, T_g_c);
                        device.finish();
                    },
                    [&] { bricks.integrate(); }),
                8.0);
    print_bar("memory of the volume 512, dense / bricks",
              static_cast<double>(dense.memory_bytes()) / static_cast<double>(bricks.volume().memory_bytes()),
              "x", 10.0, true);
    print_ratio("raycast 512 of a changed view, dense / bricks",
                measure_in_turns(
                    options.rounds, 1,
                    [&] {
                        dense.raycast(T_g_c, prediction);
                        device.finish();
                    },
                    [&] { bricks.raycast(); }),
                8.0);
}

void measure_bilateral(const Options& options) {
    const Device device{DeviceConfig{}};
    const BenchStage stage(device, {});
    BilateralFilter filter(stage);
    std::vector<double> times_ms;
    for (int i = 0; i < 100 * options.rounds; ++i) times_ms.push_back(time_ms([&] { filter.run(); }));
    print_bar("bilateral filter 640x480, median", percentile(times_ms, 50.0), "ms", 2.0, false);
    fmt::print("    shortest {:.2f} ms\n", percentile(times_ms, 0.0));
}

/// The live frame, quiet and beside a busy core, in blocks of 60 frames that take turns.
void measure_neighbour(const Options& options) {
    const Device device{DeviceConfig{}};
    BenchStage stage(device, {});
    std::vector<double> quiet_ms, busy_ms;
    const auto frames = [&](std::vector<double>& times_ms) {
        for (int i = 0; i < 60; ++i) times_ms.push_back(time_ms([&] { stage.next_frame(); }));
    };
    frames(quiet_ms);
    quiet_ms.clear();
    for (int round = 0; round < options.rounds; ++round) {
        frames(quiet_ms);
        const BusyNeighbour neighbour;
        frames(busy_ms);
    }
    const double median_ms = percentile(quiet_ms, 50.0);
    print_bar(fmt::format("busy neighbour: 95 % of {} live frames {:.1f} / quiet median {:.1f} ms",
                          busy_ms.size(), percentile(busy_ms, 95.0), median_ms),
              percentile(busy_ms, 95.0) / median_ms, "x", 2.0, false);
    fmt::print("    quiet: 95 % at {:.2f} times the median\n", percentile(quiet_ms, 95.0) / median_ms);
}

/// The live frame at 512^3 and at 256^3, in blocks of 30 frames that take turns.
void measure_resolution(const Options& options) {
    const Device device{DeviceConfig{}};
    BenchStage fine(device, {.size_vox = 512}), coarse(device, {.size_vox = 256});
    const Turns turns = measure_in_turns(
        2 * options.rounds, 30, [&] { fine.next_frame(); }, [&] { coarse.next_frame(); });
    const StageSummary touches = fine.until_touches(), coarse_touches = coarse.until_touches();
    print_bar("512^3, frame in to touches out, median", touches.median_ms, "ms", 8.0, false);
    print_bar("512^3, frame in to touches out, 99 %", touches.p99_ms, "ms", 16.0, false);
    print_bar("512^3, the same and the background after it, median", turns.first_median_ms(), "ms", 8.0,
              false);
    print_bar("512^3, the same and the background after it, 99 %", percentile(turns.first_ms, 99.0), "ms",
              16.0, false);
    print_bar(fmt::format("512^3 beside 256^3, touches out: {:.1f} / {:.1f} ms", touches.median_ms,
                          coarse_touches.median_ms),
              100.0 * (touches.median_ms / coarse_touches.median_ms - 1.0), "%", 15.0, false);
    print_bar(fmt::format("512^3 beside 256^3, with the background: {:.1f} / {:.1f} ms",
                          turns.first_median_ms(), turns.second_median_ms()),
              100.0 * (turns.median_ratio() - 1.0), "%", 15.0, false);
}

/// `run`, started again with the scan and the compiled kernels of its first start.
void measure_start(const Options& options) {
    const TemporaryFolder folder;
    run_table(options.program, folder.path(), 150);
    std::vector<double> starts_s, memory_mb;
    for (int i = 0; i < std::max(3, options.rounds / 2); ++i) {
        const ProgramRun run = run_table(options.program, folder.path(), 150);
        if (run.used_saved_scan && run.first_live_s > 0.0) starts_s.push_back(run.first_live_s);
        memory_mb.push_back(run.peak_rss_mb);
    }
    if (starts_s.empty()) throw std::runtime_error("no run went on with the saved scan");
    print_bar(fmt::format("start to the first live frame, median of {}", starts_s.size()),
              percentile(starts_s, 50.0), "s", 1.5, false);
    print_bar("peak resident memory of run at 512^3", percentile(memory_mb, 100.0), "MB", 400.0, false);
}

void measure_moving(const Options& options) {
    if (!std::filesystem::exists(options.sequence)) {
        fmt::print("moving camera: not measured, no {}\n", options.sequence.string());
        return;
    }
    for (const auto& [voxels, bar_ms] : {std::pair{256, 20.0}, std::pair{512, 24.0}})
        print_bar(fmt::format("bench --moving, {}^3 of 4.8 m, median", voxels),
                  bench_moving_ms(options.program, options.sequence, voxels), "ms", bar_ms, false);
}

const std::vector<std::pair<std::string, std::function<void(const Options&)>>> groups{
    {"dense", measure_dense},           {"bilateral", measure_bilateral}, {"neighbour", measure_neighbour},
    {"resolution", measure_resolution}, {"start", measure_start},         {"moving", measure_moving}};

int run(int argc, char** argv) {
    CLI::App app("Measures the figures that the product is held to; asserts none.");
    Options options;
    options.sequence = TOUCHSTONE_SHARED_DIR "/data/redkitchen-000-299";
    std::vector<std::string> names;
    for (const auto& [name, measure] : groups) names.push_back(name);
    app.add_option("PROGRAM", options.program, "touchstone")->required()->check(CLI::ExistingFile);
    app.add_option("--only", options.only, fmt::format("{}", fmt::join(names, ", ")))
        ->check(CLI::IsMember(names));
    app.add_option("--sequence", options.sequence, "folder of the moving camera's depth pictures");
    app.add_option("--rounds", options.rounds, "of what takes turns")->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);
    for (const auto& [name, measure] : groups) {
        if (!options.only.empty() && std::ranges::find(options.only, name) == options.only.end()) continue;
        double load[3]{};
        if (getloadavg(load, 3) == 3) fmt::print("[{}; load of the machine {:.2f}]\n", name, load[0]);
        measure(options);
    }
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("measure_bars", touchstone::run, argc, argv);
}
