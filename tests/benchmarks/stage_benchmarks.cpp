// Every stage of the live loop beside the machine's bandwidth, and the dense yardstick, in one run. Ends with
// the ratios that the product is held to.
#include <benchmark/benchmark.h>
#include <cstdio>
#include <functional>

#include "pipeline/column_drift.hpp"
#include "pipeline/kernel_program.hpp"
#include "pipeline/touch_detection.hpp"
#include "tests/benchmarks/bench_stage.hpp"
#include "tests/benchmarks/dense_yardstick.hpp"
#include "tests/benchmarks/stopwatch.hpp"
#include "yardstick_sources.hpp"

namespace touchstone {
namespace {

constexpr int size_vox = 512;
constexpr float side_m = 1.5f;
constexpr double bytes_per_float = 4.0;

/// GB/s of a = b + s c over three buffers of 64 MB on the device: the best of ten.
double triad_gb_s(const Device& device) {
    constexpr std::size_t values = std::size_t{1} << 24;
    constexpr std::string_view text =
        "__kernel void triad(__global float* a, __global const float* b, __global const float* c, const "
        "float s) {"
        " const size_t i = get_global_id(0); vstore8(vload8(i, b) + s * vload8(i, c), i, a); }";
    const std::array sources{ProgramSource{"triad.cl", text}};
    const Program program(device, sources);
    Kernel triad = program.kernel("triad");
    Buffer<float> a(device, values), b(device, values), c(device, values);
    b.fill(1.0f);
    c.fill(2.0f);
    double best_s = 1e9;
    for (int i = 0; i < 10; ++i) {
        const auto start = std::chrono::steady_clock::now();
        triad.launch({{values / 8, 1, 1}, {256, 1, 1}}, a, b, c, 0.5f);
        device.finish();
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        best_s = std::min(best_s, time.count());
    }
    return 12.0 * static_cast<double>(values) / best_s * 1e-9;
}

/// What the benchmarks share; made once, in main().
struct Run {
    explicit Run(const Device& run_device)
        : device(&run_device), stage(run_device, size_vox), triad(triad_gb_s(run_device)) {}

    double pixels() const { return static_cast<double>(map_pixels(stage.shape())); }
    void add(const std::string& name, double bytes, const std::function<void()>& work) {
        benchmark::RegisterBenchmark(name.c_str(), [=, this](benchmark::State& state) {
            measure(state, medians, name, bytes, triad, work);
        })->Unit(benchmark::kMillisecond);
    }

    const Device* device;
    BenchStage stage;
    double triad;
    Medians medians;
};

void add_picture_stages(Run& run) {
    const BenchStage& stage = run.stage;
    const Intrinsics& k = stage.intrinsics();
    auto conversion = std::make_shared<DepthMapConversion>(*run.device, DepthMapConversionConfig{}, k);
    auto live = std::make_shared<LiveMaps>(*run.device, stage.shape());
    // Millimetres in, metres out; metres in, filtered out; filtered in, normals out.
    run.add("depth map conversion", run.pixels() * (2 + 4 + 4 + 4 + 4 + 12), [=, &run] {
        conversion->convert(run.stage.view(), *live);
        run.device->finish();
    });
    auto program = std::make_shared<Program>(load_kernel_program(*run.device, "depth_map_conversion.cl"));
    auto filter = std::make_shared<Kernel>(program->kernel("bilateral_filter"));
    const DepthMapConversionConfig config;
    const FilterParams params{config.noise, config.filter_sigma_px, config.filter_range_sigmas,
                              config.min_depth_m, config.max_depth_m};
    run.add("bilateral filter", run.pixels() * 2 * bytes_per_float, [=, &run] {
        filter->launch(eight_pixels_each(run.stage.shape()), run.stage.live().depth_m, live->filtered_m,
                       run.stage.shape(), params);
        run.device->finish();
    });
}

void add_interaction_stages(Run& run) {
    const BenchStage& stage = run.stage;
    const Intrinsics& k = stage.intrinsics();
    auto association = std::make_shared<DataAssociation>(*run.device, DataAssociationConfig{}, k);
    auto codes = std::make_shared<Buffer<std::uint8_t>>(*run.device, map_pixels(stage.shape()));
    auto no_fallback = std::make_shared<Buffer<float>>(*run.device, map_pixels(stage.shape()));
    no_fallback->fill(0.0f);
    // Depth and normals of both, one code.
    run.add("data association", run.pixels() * (16 + 16 + 1), [=, &run] {
        association->associate(run.stage.live(), run.stage.background().prediction(), *no_fallback,
                               RigidTransform::Identity(), *codes);
        run.device->finish();
    });
    auto segmentation =
        std::make_shared<ForegroundSegmentation>(*run.device, ForegroundSegmentationConfig{}, k);
    segmentation->segment(stage.live(), stage.background().prediction());
    const Foreground* foreground = &segmentation->segment(stage.live(), stage.background().prediction());
    run.add("foreground segmentation", 0.0, [=, &run] {
        segmentation->segment(run.stage.live(), run.stage.background().prediction());
        run.device->finish();
    });
    auto touch = std::make_shared<TouchDetection>(*run.device, TouchDetectionConfig{}, k);
    run.add("touch detection", 0.0, [=, &run, time_us = std::uint64_t{0}]() mutable {
        std::vector<PixelRegion> regions;
        for (const ForegroundComponent& part : foreground->components)
            regions.push_back(
                {part.box.min_x_px, part.box.min_y_px, part.box.max_x_px + 1, part.box.max_y_px + 1});
        touch->detect({run.stage.live(), run.stage.background().prediction(), foreground->mask, regions,
                       run.stage.area(), time_us += 33333});
        (void)segmentation;
    });
    auto drift = std::make_shared<ColumnDrift>(*run.device, ColumnDriftConfig{}, k);
    run.add("column drift", run.pixels() * (4 + 4 + 1), [=, &run] {
        drift->update(run.stage.live(), run.stage.background().prediction(), *foreground);
        (void)segmentation;
    });
}

void add_volume_stages(Run& run) {
    const BenchStage& stage = run.stage;
    const Intrinsics& k = stage.intrinsics();
    VolumeConfig config;
    config.size_vox = size_vox;
    config.side_m = side_m;
    auto volume = std::make_shared<TsdfVolume>(*run.device, config);
    auto weighting = std::make_shared<SampleWeighting>(*run.device, SampleWeightConfig{}, k);
    auto integration = std::make_shared<VolumetricIntegration>(*run.device, k);
    auto prediction = std::make_shared<SurfacePrediction>(*run.device, stage.shape());
    auto raycasting = std::make_shared<Raycasting>(*run.device, k);
    const RigidTransform T_g_c = stage.background().T_g_c();
    const auto integrate = [=, &run] {
        integration->integrate(*volume, run.stage.live().depth_m, weighting->weigh(run.stage.live()), T_g_c,
                               all_layers(*volume));
        run.device->finish();
    };
    integrate();
    // Each voxel of the bricks in use is read and written.
    run.add("integration 512", 2.0 * 4.0 * BRICK_VOXELS * volume->bricks_in_use(), integrate);
    run.add("raycast 512, changed view", run.pixels() * 16, [=, &run] {
        raycasting->raycast(*volume, T_g_c, *prediction);
        run.device->finish();
    });
    run.medians["memory 512, MB"] = static_cast<double>(volume->memory_bytes()) / 1e6;
}

void add_dense(Run& run, int dense_vox) {
    const float truncation_m = std::max(0.012f, 6.0f * side_m / static_cast<float>(dense_vox));
    auto dense =
        std::make_shared<DenseVolume>(*run.device, run.stage.intrinsics(), dense_vox, side_m, truncation_m);
    const RigidTransform T_g_c = run.stage.background().T_g_c();
    auto prediction = std::make_shared<SurfacePrediction>(*run.device, run.stage.shape());
    const std::string size = std::to_string(dense_vox);
    const double voxels = static_cast<double>(dense->memory_bytes()) / 4.0;
    run.add("dense integration " + size, 8.0 * voxels, [=, &run] {
        dense->integrate(run.stage.live().depth_m, T_g_c);
        run.device->finish();
    });
    run.add("dense raycast " + size, run.pixels() * 16, [=, &run] {
        dense->raycast(T_g_c, *prediction);
        run.device->finish();
    });
    run.medians["dense memory " + size + ", MB"] = static_cast<double>(dense->memory_bytes()) / 1e6;
}

void print_ratios(const Medians& medians) {
    const auto of = [&](const std::string& name) {
        const auto found = medians.find(name);
        return found == medians.end() ? 0.0 : found->second;
    };
    const auto ratio = [&](const char* what, const std::string& dense, const std::string& ours,
                           const char* bar) {
        if (of(dense) > 0.0 && of(ours) > 0.0)
            std::printf("%-34s %8.2f / %8.2f = %6.1f  (%s)\n", what, of(dense), of(ours),
                        of(dense) / of(ours), bar);
    };
    ratio("integration, dense / bricks, ms", "dense integration 512", "integration 512", "bar 8");
    ratio("memory, dense / bricks, MB", "dense memory 512, MB", "memory 512, MB", "bar 10");
    ratio("raycast, dense / bricks, ms", "dense raycast 512", "raycast 512, changed view", "bar 8");
    if (of("bilateral filter") > 0.0)
        std::printf("bilateral filter, ms %8.2f  (bar 2)\n", of("bilateral filter"));
    if (of("whole frame") > 0.0) std::printf("whole frame, ms %8.2f  (bar 8)\n", of("whole frame"));
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    using namespace touchstone;
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 64;
    const Device device{DeviceConfig{}};
    Run run(device);
    std::printf("%s, triad %.1f GB/s\n", device.name().c_str(), run.triad);
    add_picture_stages(run);
    add_interaction_stages(run);
    add_volume_stages(run);
    run.add("whole frame", 0.0, [&run] { run.stage.next_frame(); });
    add_dense(run, 256);
    add_dense(run, size_vox);
    benchmark::RunSpecifiedBenchmarks();
    print_ratios(run.medians);
    return 0;
}
