// How time and memory grow with the volume's resolution, the picture's size, the hands in view and the
// particles, the dense method beside it: measure_scale [--plot FILE.png]. Each scene is measured in a process
// of its own.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "platform/opencl/device_error.hpp"
#include "platform/system/log.hpp"
#include "tests/benchmarks/bench_stage.hpp"
#include "tests/benchmarks/brick_volume.hpp"
#include "tests/benchmarks/dense_yardstick.hpp"
#include "tests/benchmarks/particle_bench.hpp"
#include "tests/benchmarks/scale_chart.hpp"
#include "tests/support/program_main.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

constexpr int live_frames = 180, volume_runs = 9, dense_runs = 3, particle_frames = 40;

/// Milliseconds of processor time, memory in MB. What was not measured is 0.
struct ScaleFigures {
    double frame_ms = 0.0, integration_ms = 0.0, raycast_ms = 0.0, loop_mb = 0.0, bricks_mb = 0.0;
    double dense_integration_ms = 0.0, dense_raycast_ms = 0.0, dense_mb = 0.0;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ScaleFigures, frame_ms, integration_ms, raycast_ms, loop_mb, bricks_mb,
                                   dense_integration_ms, dense_raycast_ms, dense_mb)

/// Processor time of a run, all cores together, mean: a busy machine changes it less than the time that
/// passes.
template <class Work>
double processor_ms(int runs, const Work& work) {
    work();
    const std::clock_t start = std::clock();
    for (int i = 0; i < runs; ++i) work();
    return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / runs;
}

void measure_dense(const BenchStage& stage, const BenchScene& scene, float truncation_m,
                   ScaleFigures& figures) {
    const Device& device = stage.device();
    const RigidTransform T_g_c = stage.background().T_g_c();
    DenseVolume dense(device, stage.intrinsics(), scene.size_vox, bench_side_m, truncation_m);
    SurfacePrediction prediction(device, stage.shape());
    figures.dense_mb = static_cast<double>(dense.memory_bytes()) / 1e6;
    figures.dense_integration_ms = processor_ms(dense_runs, [&] {
        dense.integrate(stage.live().depth_m, T_g_c);
        device.finish();
    });
    figures.dense_raycast_ms = processor_ms(dense_runs, [&] {
        dense.raycast(T_g_c, prediction);
        device.finish();
    });
}

ScaleFigures measure(const BenchScene& scene) {
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = default_cache_dir()});
    BenchStage stage(device, scene);
    ScaleFigures figures;
    figures.loop_mb = stage.loop_memory_mb();
    figures.frame_ms = processor_ms(live_frames, [&] { stage.next_frame(); });
    BrickVolume bricks(stage, scene.size_vox);
    figures.integration_ms = processor_ms(volume_runs, [&] { bricks.integrate(); });
    figures.raycast_ms = processor_ms(volume_runs, [&] { bricks.raycast(); });
    figures.bricks_mb = static_cast<double>(bricks.volume().memory_bytes()) / 1e6;
    try {
        measure_dense(stage, scene, bricks.volume().params().max_truncation_m, figures);
    } catch (const DeviceError& error) {
        fmt::print(stderr, "the dense volume of {}^3 does not fit the device: {}\n", scene.size_vox,
                   error.what());
    }
    return figures;
}

/// measure() by this program, in a process of its own.
ScaleFigures measure_apart(const std::string& self, const BenchScene& scene) {
    const test::ProgramResult result =
        test::run_program({self, "--scene", std::to_string(scene.size_vox), std::to_string(scene.hands),
                           std::to_string(scene.width_px)});
    if (result.status != 0) throw std::runtime_error(result.err);
    std::fputs(result.err.c_str(), stderr);
    const auto figures = nlohmann::json::parse(result.out).get<ScaleFigures>();
    fmt::print(
        "{:>5}^3 {:>5} px {} hands {:>9.1f} {:>9.1f} {:>9.1f} {:>8.0f} {:>8.1f} {:>9.1f} {:>9.1f} {:>8.1f}\n",
        scene.size_vox, scene.width_px, scene.hands, figures.frame_ms, figures.integration_ms,
        figures.raycast_ms, figures.loop_mb, figures.bricks_mb, figures.dense_integration_ms,
        figures.dense_raycast_ms, figures.dense_mb);
    std::fflush(stdout);
    return figures;
}

using Series = std::vector<std::pair<double, ScaleFigures>>;

Curve curve(const std::string& name, const Series& series, double ScaleFigures::*value) {
    Curve result{name, name.starts_with("dense"), {}};
    for (const auto& [x, figures] : series)
        if (figures.*value > 0.0) result.points.emplace_back(x, figures.*value);
    return result;
}

std::vector<Curve> time_curves(const Series& series) {
    return {curve("live frame", series, &ScaleFigures::frame_ms),
            curve("integration", series, &ScaleFigures::integration_ms),
            curve("raycast", series, &ScaleFigures::raycast_ms),
            curve("dense integration", series, &ScaleFigures::dense_integration_ms),
            curve("dense raycast", series, &ScaleFigures::dense_raycast_ms)};
}

std::vector<Curve> memory_curves(const Series& series) {
    return {curve("whole loop", series, &ScaleFigures::loop_mb),
            curve("volume", series, &ScaleFigures::bricks_mb), Curve{},
            curve("dense volume", series, &ScaleFigures::dense_mb)};
}

void add_panels(ScaleChart& chart, const std::string& axis, const Series& series,
                const std::vector<std::string>& labels, bool logarithmic) {
    ScalePanel panel{axis, "processor time, ms", {}, logarithmic, time_curves(series)};
    for (std::size_t i = 0; i < series.size(); ++i) panel.ticks.emplace_back(series[i].first, labels[i]);
    if (!logarithmic) panel.curves.resize(1);
    chart.panels.push_back(panel);
    panel.y_axis = "MB";
    panel.curves = memory_curves(series);
    if (!logarithmic) panel.curves.resize(2);
    chart.panels.push_back(panel);
}

void add_particle_panels(ScaleChart& chart) {
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = default_cache_dir()});
    Curve time{"particles", false, {}}, share{"a particle", false, {}};
    std::vector<std::pair<double, std::string>> ticks;
    for (const int thousands : {1, 4, 16, 32, 128}) {
        const int count = 1024 * thousands;
        ParticleBench bench(device, count);
        const double frame_ms = processor_ms(particle_frames, [&] { bench.next_frame(); });
        fmt::print("{:>10} particles {:>9.1f} ms a frame\n", count, frame_ms);
        ticks.emplace_back(count, fmt::format("{}k", thousands));
        time.points.emplace_back(count, frame_ms);
        share.points.emplace_back(count, 1e3 * frame_ms / count);
    }
    const std::string axis = "particles, three deep, two hands among them";
    chart.panels.push_back({axis, "processor time, ms", ticks, true, {time}});
    chart.panels.push_back({axis, "microseconds", ticks, true, {share}});
}

/// The chart, of the scenes as they are measured.
ScaleChart measure_all(const std::string& self) {
    fmt::print("{:>28} {:>9} {:>9} {:>9} {:>8} {:>8} {:>9} {:>9} {:>8}\n", "", "frame ms", "integr.",
               "raycast", "loop MB", "bricks", "d.integr.", "d.raycast", "dense MB");
    ScaleChart chart{"What a frame costs, on two CPU cores",
                     "simulated table, a cube of 1.5 m; processor time of both cores together; dashed: every "
                     "voxel swept, every ray from "
                     "the front (1024^3 does not fit the device)",
                     {}};
    Series series;
    for (const int size_vox : {128, 256, 512, 1024})
        series.emplace_back(size_vox, measure_apart(self, {.size_vox = size_vox}));
    add_panels(chart, "voxels of the volume (640x480, two hands)", series,
               {"128^3", "256^3", "512^3", "1024^3"}, true);
    series.clear();
    for (const int width_px : {320, 640, 1280})
        series.emplace_back(width_px, measure_apart(self, {.width_px = width_px}));
    add_panels(chart, "picture (512^3, two hands; 640x480 resampled)", series,
               {"320x240", "640x480", "1280x960"}, true);
    series.clear();
    for (const int hands : {0, 1, 2}) series.emplace_back(hands, measure_apart(self, {.hands = hands}));
    add_panels(chart, "hands in view (512^3, 640x480)", series, {"0", "1", "2"}, false);
    add_particle_panels(chart);
    return chart;
}

int run(int argc, char** argv) {
    CLI::App app("How time and memory grow with resolution, picture and hands.");
    std::vector<int> scene;
    std::filesystem::path png;
    app.add_option("--scene", scene, "only one: voxels along a side, hands, width of the picture")
        ->expected(3);
    app.add_option("--plot", png, "chart, PNG; needs gnuplot");
    CLI11_PARSE(app, argc, argv);
    set_log_level(LogLevel::error);
    if (!scene.empty()) {
        fmt::print("{}\n", nlohmann::json(measure({scene[0], scene[1], scene[2]})).dump());
        return 0;
    }
    const ScaleChart chart = measure_all(std::filesystem::read_symlink("/proc/self/exe").string());
    if (!png.empty()) draw_scale_chart(chart, png);
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("measure_scale", touchstone::run, argc, argv);
}
