#include "tests/benchmarks/bench_stage.hpp"

#include <malloc.h>
#include <stdexcept>

#include "pipeline/kernel_program.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "platform/system/process_memory.hpp"

namespace touchstone {

namespace {

// Hands come in after a second; the scan is over by then.
constexpr int scan_frames = 60, live_frames = 90;

InteractionConfig config_of(int size_vox) {
    InteractionConfig config;
    config.background.volume.size_vox = size_vox;
    config.background.volume.side_m = bench_side_m;
    config.background.fit_side = false;
    return config;
}

/// Pixels keep their angles: a pixel's middle is half a pixel from its border in both pictures.
Intrinsics resized(const Intrinsics& k, int width_px) {
    const float scale = static_cast<float>(width_px) / static_cast<float>(k.width_px);
    Intrinsics result = k;
    result.fx_px *= scale;
    result.fy_px *= scale;
    result.cx_px = (k.cx_px + 0.5f) * scale - 0.5f;
    result.cy_px = (k.cy_px + 0.5f) * scale - 0.5f;
    result.width_px = width_px;
    result.height_px = k.height_px * width_px / k.width_px;
    return result;
}

/// The nearest pixels.
SourceFrame resized(const SourceFrame& frame, const Intrinsics& from, const Intrinsics& to) {
    SourceFrame result = frame;
    result.depth_mm.clear();
    for (int y = 0; y < to.height_px; ++y) {
        const int row = y * from.height_px / to.height_px;
        for (int x = 0; x < to.width_px; ++x)
            result.depth_mm.push_back(frame.depth_mm[static_cast<std::size_t>(
                row * from.width_px + x * from.width_px / to.width_px)]);
    }
    return result;
}

double trimmed_mb() {
    malloc_trim(0);
    return resident_mb();
}

}  // namespace

BenchStage::BenchStage(const Device& device, const BenchScene& scene) : device_(&device) {
    SimulatorSource source(parse_simulator_uri("flat?seed=1&empty=1&hands=" + std::to_string(scene.hands)));
    const Intrinsics made = source.info().intrinsics;
    intrinsics_ = resized(made, scene.width_px);
    for (int i = 0; i < scan_frames + live_frames; ++i) {
        SourceFrame frame;
        source.next(frame);
        frames_.push_back(scene.width_px == made.width_px ? frame : resized(frame, made, intrinsics_));
    }
    const double before_mb = trimmed_mb();
    pipeline_.emplace(device, config_of(scene.size_vox), intrinsics_);
    for (int i = 0; i < scan_frames; ++i) process(frames_[static_cast<std::size_t>(i)]);
    if (!pipeline_->area()) throw std::runtime_error("the table of the benchmarks was not scanned");
    loop_memory_mb_ = trimmed_mb() - before_mb;
    frames_.erase(frames_.begin(), frames_.begin() + scan_frames);
    live_.emplace(device, make_map_shape(intrinsics_));
    DepthMapConversion(device, {}, intrinsics_).convert(view(), *live_);
    device.finish();
}

void BenchStage::process(const SourceFrame& frame) {
    time_us_ += 33333;
    pipeline_->process({frame.depth_mm, intrinsics_}, time_us_);
}

void BenchStage::next_frame() {
    process(frames_[next_]);
    if (next_ + 1 == frames_.size()) forward_ = false;
    if (next_ == 0) forward_ = true;
    next_ += forward_ ? std::size_t{1} : static_cast<std::size_t>(-1);
}

BilateralFilter::BilateralFilter(const BenchStage& stage)
    : stage_(&stage),
      program_(load_kernel_program(stage.device(), "depth_map_conversion.cl")),
      kernel_(program_.kernel("bilateral_filter")),
      filtered_m_(stage.device(), map_pixels(stage.shape())) {
    const DepthMapConversionConfig config;
    params_ = {config.noise, config.filter_sigma_px, config.filter_range_sigmas, config.min_depth_m,
               config.max_depth_m};
}

void BilateralFilter::run() {
    const MapShape& shape = stage_->shape();
    kernel_.launch(sixteen_pixels_each(shape), stage_->live().depth_m, filtered_m_, shape, params_);
    stage_->device().finish();
}

}  // namespace touchstone
