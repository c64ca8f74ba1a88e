#pragma once

#include <string>
#include <vector>

#include "pipeline/interaction_pipeline.hpp"
#include "platform/openni2_drivers/common/frame_source.hpp"

namespace touchstone {

/// A simulated table with two hands over it, scanned, and what each stage of the live loop reads there.
class BenchStage {
  public:
    /// `size_vox` is of the background, a cube of 1.5 m.
    BenchStage(const Device& device, int size_vox);

    const Device& device() const { return *device_; }
    const Intrinsics& intrinsics() const { return intrinsics_; }
    const MapShape& shape() const { return live_.shape; }
    const BackgroundModel& background() const { return *pipeline_.background(); }
    const InteractiveArea& area() const { return *pipeline_.area(); }
    /// Maps of a frame with both hands.
    const LiveMaps& live() const { return live_; }
    /// That frame as it came.
    DepthView view() const { return {frames_.back().depth_mm, intrinsics_}; }
    /// The next frame through the whole live loop; to and fro through the frames that were made.
    void next_frame();

  private:
    const Device* device_;
    Intrinsics intrinsics_;
    std::vector<SourceFrame> frames_;  ///< live ones
    InteractionPipeline pipeline_;
    LiveMaps live_;
    std::size_t next_ = 0;
    bool forward_ = true;
    std::uint64_t time_us_ = 0;
};

}  // namespace touchstone
