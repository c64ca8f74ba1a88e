#pragma once

#include <string>
#include <vector>

#include "pipeline/interaction_pipeline.hpp"
#include "platform/openni2_drivers/common/frame_source.hpp"

namespace touchstone {

/// What a stage of the benchmarks shows.
struct BenchScene {
    int size_vox = 512;  ///< of the background, a cube of bench_side_m
    int hands = 2;       ///< 0 to 2
    int width_px = 640;  ///< of the pictures, 4:3; other than 640 they are the simulator's, resampled
};

constexpr float bench_side_m = 1.5f;

/// A simulated table, scanned, with hands over it, and what each stage of the live loop reads there.
class BenchStage {
  public:
    BenchStage(const Device& device, const BenchScene& scene);

    const Device& device() const { return *device_; }
    const Intrinsics& intrinsics() const { return intrinsics_; }
    const MapShape& shape() const { return live_->shape; }
    const BackgroundModel& background() const { return *pipeline_->background(); }
    const InteractiveArea& area() const { return *pipeline_->area(); }
    /// Maps of a frame with the hands.
    const LiveMaps& live() const { return *live_; }
    /// That frame as it came.
    DepthView view() const { return {frames_.back().depth_mm, intrinsics_}; }
    /// The next frame through the whole live loop; to and fro through the frames that were made.
    void next_frame();
    /// Of the last frames, from each frame to its touches.
    StageSummary until_touches() const { return pipeline_->stage_times().summary("touches out"); }
    /// By how much the process grew when the loop was set up and had scanned.
    double loop_memory_mb() const { return loop_memory_mb_; }

  private:
    void process(const SourceFrame& frame);

    const Device* device_;
    Intrinsics intrinsics_;
    std::vector<SourceFrame> frames_;  ///< live ones
    std::optional<InteractionPipeline> pipeline_;
    std::optional<LiveMaps> live_;
    std::size_t next_ = 0;
    bool forward_ = true;
    std::uint64_t time_us_ = 0;
    double loop_memory_mb_ = 0.0;
};

/// The conversion's bilateral filter on its own, on a stage's frame.
class BilateralFilter {
  public:
    explicit BilateralFilter(const BenchStage& stage);

    /// Waits for the device.
    void run();

  private:
    const BenchStage* stage_;
    FilterParams params_;
    Program program_;
    Kernel kernel_;
    Buffer<float> filtered_m_;
};

}  // namespace touchstone
