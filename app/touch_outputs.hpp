#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/command_line.hpp"
#include "pipeline/named_areas.hpp"
#include "platform/output/osc_bundle.hpp"
#include "platform/output/touch_sink.hpp"

namespace touchstone {

/// Everything that is told of touches, as command line and configuration say. Of a table with named areas
/// each is a TUIO source of its own, and what is outside them is told to event log and touch screen only.
class TouchOutputs {
  public:
    /// Throws Error where one cannot be opened.
    TouchOutputs(const RunOptions& options, std::span<const NamedArea> areas);

    /// TUIO sources end, and others begin; who listens stays connected.
    void set_areas(std::span<const NamedArea> areas);
    void publish(const TouchReport& report);
    /// The sensor is lost: see TouchSink.
    void release_all();
    void idle();

  private:
    struct Port {
        std::shared_ptr<OscChannel> channel;
        std::optional<double> unit_height_mm;
    };

    std::string source_;
    std::vector<Port> ports_;
    std::vector<std::unique_ptr<TouchSink>> of_table_, of_areas_;
};

}  // namespace touchstone
