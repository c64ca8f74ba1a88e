#pragma once

#include <memory>

#include "platform/openni2_drivers/common/frame_source.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone {

/// A simulated camera that fails as real ones do. Times are those of the frames, from the first one.
class FaultySource : public FrameSource {
  public:
    FaultySource(std::unique_ptr<FrameSource> source, const SimulatorFaults& faults)
        : source_(std::move(source)), faults_(faults) {}

    const SourceInfo& info() const override { return source_->info(); }
    void enable_color(bool enabled) override { source_->enable_color(enabled); }
    void restarted() override;
    bool next(SourceFrame& frame) override;

  private:
    bool lasts(double start_s, double time_s) const;

    std::unique_ptr<FrameSource> source_;
    SimulatorFaults faults_;
    SourceFrame made_;  ///< as the scene gives it
    std::vector<std::uint16_t> last_mm_;
    std::vector<std::uint8_t> last_rgb_;
    double time_s_ = 0.0;
    bool torn_ = false;
};

}  // namespace touchstone
