// Every stage of the live loop beside the machine's bandwidth, and the dense yardstick, in one run.
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <functional>

#include "pipeline/column_drift.hpp"
#include "pipeline/touch_detection.hpp"
#include "tests/benchmarks/bench_stage.hpp"
#include "tests/benchmarks/brick_volume.hpp"
#include "tests/benchmarks/dense_yardstick.hpp"
#include "tests/benchmarks/stage_measurement.hpp"

namespace touchstone {
namespace {

constexpr int size_vox = 512;
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
        : device(&run_device),
          stage(run_device, BenchScene{.size_vox = size_vox}),
          triad(triad_gb_s(run_device)) {}

    double pixels() const { return static_cast<double>(map_pixels(stage.shape())); }
    void add(const std::string& name, double bytes, const std::function<void()>& work) {
        benchmark::RegisterBenchmark(name.c_str(), [=, this](benchmark::State& state) {
            measure(state, bytes, triad, work);
        })->Unit(benchmark::kMillisecond);
    }

    const Device* device;
    BenchStage stage;
    double triad;
    std::optional<DenseVolume> dense;
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
    auto filter = std::make_shared<BilateralFilter>(stage);
    run.add("bilateral filter", run.pixels() * 2 * bytes_per_float, [=] { filter->run(); });
}

/// Pixels of the boxes that touch detection looks at.
double region_pixels(const std::vector<PixelRegion>& regions) {
    double pixels = 0.0;
    for (const PixelRegion& region : regions)
        pixels += static_cast<double>(region.x1 - region.x0) * static_cast<double>(region.y1 - region.y0);
    return pixels;
}

std::vector<PixelRegion> regions_of(const Foreground& foreground) {
    std::vector<PixelRegion> regions;
    for (const ForegroundComponent& part : foreground.components)
        regions.push_back(
            {part.box.min_x_px, part.box.min_y_px, part.box.max_x_px + 1, part.box.max_y_px + 1});
    return regions;
}

/// Members: what data association rejects.
void add_connected_components(Run& run, const std::shared_ptr<Buffer<std::uint8_t>>& codes) {
    auto members = std::make_shared<Buffer<std::uint8_t>>(*run.device, map_pixels(run.stage.shape()));
    std::vector<std::uint8_t> seeds;
    for (const std::uint8_t code : codes->read())
        seeds.push_back(code == ASSOCIATION_IN_FRONT ? MEMBER_SEED : MEMBER_NONE);
    members->write(seeds);
    auto components =
        std::make_shared<ConnectedComponents>(*run.device, ConnectedComponentsConfig{}, run.stage.shape());
    // Member and depth in, label out.
    run.add("connected components", run.pixels() * (1 + 4 + 4),
            [=, &run] { components->find(*members, run.stage.live().filtered_m); });
}

void add_association_stages(Run& run) {
    const BenchStage& stage = run.stage;
    auto association =
        std::make_shared<DataAssociation>(*run.device, DataAssociationConfig{}, stage.intrinsics());
    auto codes = std::make_shared<Buffer<std::uint8_t>>(*run.device, map_pixels(stage.shape()));
    auto no_fallback = std::make_shared<Buffer<float>>(*run.device, map_pixels(stage.shape()));
    no_fallback->fill(0.0f);
    const auto associate = [=, &run] {
        association->associate(run.stage.live(), run.stage.background().prediction(), *no_fallback,
                               RigidTransform::Identity(), *codes);
        run.device->finish();
    };
    // Depth and normals of both, one code.
    run.add("data association", run.pixels() * (16 + 16 + 1), associate);
    associate();
    add_connected_components(run, codes);
}

void add_interaction_stages(Run& run) {
    const BenchStage& stage = run.stage;
    const Intrinsics& k = stage.intrinsics();
    auto segmentation =
        std::make_shared<ForegroundSegmentation>(*run.device, ForegroundSegmentationConfig{}, k);
    segmentation->segment(stage.live(), stage.background().prediction());
    const Foreground* foreground = &segmentation->segment(stage.live(), stage.background().prediction());
    const std::vector<PixelRegion> regions = regions_of(*foreground);
    // Depth and normals of both; code, two masks and label out.
    run.add("foreground segmentation", run.pixels() * (16 + 16 + 1 + 1 + 1 + 4), [=, &run] {
        segmentation->segment(run.stage.live(), run.stage.background().prediction());
        segmentation->mask_background(run.stage.live(), run.stage.background().prediction());
        run.device->finish();
    });
    auto touch = std::make_shared<TouchDetection>(*run.device, TouchDetectionConfig{}, k);
    // In the boxes around hands: mask, both depths, the background's normals.
    run.add("touch detection", region_pixels(regions) * (1 + 4 + 16),
            [=, &run, time_us = std::uint64_t{0}]() mutable {
                touch->detect({run.stage.live(), run.stage.background().prediction(), foreground->mask,
                               regions, run.stage.area(), time_us += 33333});
                (void)segmentation;
            });
    const ColumnDriftConfig drift_config;
    auto drift = std::make_shared<ColumnDrift>(*run.device, drift_config, k);
    // Of every so many-th row: both depths and the mask.
    run.add("column drift", run.pixels() / drift_config.row_step * (4 + 4 + 1), [=, &run] {
        drift->update(run.stage.live(), run.stage.background().prediction(), *foreground);
        (void)segmentation;
    });
}

void add_volume_stages(Run& run) {
    auto bricks = std::make_shared<BrickVolume>(run.stage, size_vox);
    // Each voxel of the bricks in use is read and written.
    run.add("integration 512", 2.0 * 4.0 * BRICK_VOXELS * bricks->volume().bricks_in_use(),
            [=] { bricks->integrate(); });
    // The voxels of the changed bricks are read.
    run.add("raycast 512, refresh", 4.0 * BRICK_VOXELS * static_cast<double>(bricks->slice_bricks()),
            [=] { bricks->refresh(); });
    // Depth and normals out.
    run.add("raycast 512, changed view", run.pixels() * 16, [=] { bricks->raycast(); });
}

/// The dense array is there once it is measured, and no longer than until the next one is.
void add_dense(Run& run, int dense_vox) {
    auto prediction = std::make_shared<SurfacePrediction>(*run.device, run.stage.shape());
    const auto dense = [&run, dense_vox]() -> DenseVolume& {
        const float truncation_m = std::max(0.012f, 6.0f * bench_side_m / static_cast<float>(dense_vox));
        if (run.dense && run.dense->size_vox() == dense_vox) return *run.dense;
        run.dense.emplace(*run.device, run.stage.intrinsics(), dense_vox, bench_side_m, truncation_m);
        run.dense->integrate(run.stage.live().depth_m, run.stage.background().T_g_c());
        return *run.dense;
    };
    const std::string size = std::to_string(dense_vox);
    const double bytes = 4.0 * std::pow(static_cast<double>(dense_vox), 3.0);
    // Each voxel is read and written.
    run.add("dense integration " + size, 2.0 * bytes, [=, &run] {
        dense().integrate(run.stage.live().depth_m, run.stage.background().T_g_c());
        run.device->finish();
    });
    // Depth and normals out.
    run.add("dense raycast " + size, run.pixels() * 16, [=, &run] {
        dense().raycast(run.stage.background().T_g_c(), *prediction);
        run.device->finish();
    });
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
    add_association_stages(run);
    add_interaction_stages(run);
    add_volume_stages(run);
    // Millimetres in; what conversion, segmentation and drift make, once.
    run.add("whole frame", run.pixels() * (2 + 4 + 4 + 12 + 1 + 1 + 1 + 4),
            [&run] { run.stage.next_frame(); });
    add_dense(run, 256);
    add_dense(run, size_vox);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
