#pragma once

#include <memory>

#include "platform/openni2_drivers/common/frame_source.hpp"
#include "platform/openni2_drivers/simulator/random.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone {

/// A simulated camera that fails as real ones do. Times are those of the frames, from the first one.
class FaultySource : public FrameSource {
  public:
    /// `random` draws the faults of every_s.
    FaultySource(std::unique_ptr<FrameSource> source, const SimulatorFaults& faults,
                 const sim::Random& random = {1, 0});

    const SourceInfo& info() const override { return source_->info(); }
    void enable_color(bool enabled) override { source_->enable_color(enabled); }
    void restarted() override;
    bool next(SourceFrame& frame) override;

  private:
    bool lasts(double start_s, double time_s) const;
    void draw_fault();

    std::unique_ptr<FrameSource> source_;
    SimulatorFaults faults_;
    SourceFrame made_;  ///< as the scene gives it
    std::vector<std::uint16_t> last_mm_;
    std::vector<std::uint8_t> last_rgb_;
    sim::Random random_;
    double time_s_ = 0.0;
    double next_drawn_s_ = 0.0;
    std::uint64_t clock_ahead_us_ = 0;
};

}  // namespace touchstone
