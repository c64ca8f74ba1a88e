#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "platform/openni2_drivers/common/frame_source.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone {

/// A Kinect v1 over a table that exists only as formulas, with hands that touch it. Equal configurations give
/// equal frames; nothing depends on the clock.
class SimulatorSource : public FrameSource {
  public:
    /// Renders the static scene. Throws Error{io_error} when the truth cannot be written.
    explicit SimulatorSource(const SimulatorConfig& config);
    ~SimulatorSource() override;

    const SourceInfo& info() const override;
    void enable_color(bool enabled) override;
    bool next(SourceFrame& frame) override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// From the part of a sensor URI after `sim:`: a table or a scene of meshes. Throws Error{usage} on an
/// unknown scene, key or value. `opening` tells one opening of a camera from the next: faults are drawn anew.
std::unique_ptr<FrameSource> open_simulator(std::string_view uri_after_scheme, std::uint64_t opening = 0);

}  // namespace touchstone
