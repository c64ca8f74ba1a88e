#pragma once

#include <array>
#include <optional>
#include <vector>

#include "platform/openni2_drivers/simulator/hand_layer.hpp"
#include "platform/openni2_drivers/simulator/hand_script.hpp"

namespace touchstone {

/// What a simulated table's camera sees without noise, frame by frame: the same hands as SimulatorSource
/// shows for the same configuration. Of a camera that is not knocked.
class HandTruth {
  public:
    explicit HandTruth(const SimulatorConfig& config);

    struct Moment {
        sim::Picture picture;
        std::array<std::optional<sim::Hand>, 2> hands;
    };
    /// Frames must be asked for in order.
    Moment at(int frame);
    const sim::TableView& view() const { return view_; }

  private:
    SimulatorConfig config_;
    sim::TableView view_;
    sim::Scene scene_;
    std::vector<float> static_depth_m_;
    std::vector<sim::HandScript> scripts_;
};

/// How far the parts of a hand moved on average between two frames, metres; 0 where one is missing.
float hand_step_m(const std::optional<sim::Hand>& before, const std::optional<sim::Hand>& now);

}  // namespace touchstone
