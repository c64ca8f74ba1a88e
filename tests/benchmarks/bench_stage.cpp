#include "tests/benchmarks/bench_stage.hpp"

#include "platform/openni2_drivers/simulator/simulator_source.hpp"

namespace touchstone {

namespace {

constexpr int live_frames = 90;

InteractionConfig config_of(int size_vox) {
    InteractionConfig config;
    config.background.volume.size_vox = size_vox;
    config.background.volume.side_m = 1.5f;
    config.background.fit_side = false;
    return config;
}

SourceFrame next_of(FrameSource& source) {
    SourceFrame frame;
    source.next(frame);
    return frame;
}

}  // namespace

BenchStage::BenchStage(const Device& device, int size_vox)
    : device_(&device),
      intrinsics_(SimulatorSource(parse_simulator_uri("flat?hands=0")).info().intrinsics),
      pipeline_(device, config_of(size_vox), intrinsics_),
      live_(device, make_map_shape(intrinsics_)) {
    SimulatorSource source(parse_simulator_uri("flat?hands=2&seed=1&empty=1"));
    // Hands come in after a second; the scan is over by then.
    for (int i = 0; i < 60; ++i) {
        const SourceFrame frame = next_of(source);
        pipeline_.process({frame.depth_mm, intrinsics_}, frame.timestamp_us);
        time_us_ = frame.timestamp_us;
    }
    for (int i = 0; i < live_frames; ++i) frames_.push_back(next_of(source));
    DepthMapConversion conversion(device, {}, intrinsics_);
    conversion.convert(view(), live_);
    device.finish();
}

void BenchStage::next_frame() {
    time_us_ += 33333;
    pipeline_.process({frames_[next_].depth_mm, intrinsics_}, time_us_);
    if (next_ + 1 == frames_.size()) forward_ = false;
    if (next_ == 0) forward_ = true;
    next_ += forward_ ? std::size_t{1} : static_cast<std::size_t>(-1);
}

}  // namespace touchstone
