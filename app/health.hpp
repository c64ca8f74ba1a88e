#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "platform/output/health_page.hpp"

namespace touchstone {

struct HealthConfig {
    int port = 0;  ///< of the page; 0: none
};

/// What a minute of the table was, for the journal: the figures now against those of `before`, `seconds` ago.
std::string health_line(const HealthFigures& before, const HealthFigures& now, double seconds);

/// Counts what happens to a running table; a page shows it, and a line a minute tells it in the log.
class Health {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Throws Error{unavailable} where the page's port is taken.
    explicit Health(const HealthConfig& config, Time now = std::chrono::steady_clock::now());

    /// A frame was processed; `camera_rate_hz` is what its camera promises.
    void frame(std::uint64_t time_us, double camera_rate_hz, int touches_down);
    /// The next frame may come from anywhere in time.
    void camera_opened() { last_frame_us_.reset(); }
    void fault(const std::string& kind) { ++figures_.faults[kind]; }
    /// Something that the next start would have found could not be written.
    void unsaved(const std::string& what) { ++figures_.unsaved[what]; }
    /// As DepthCamera tells them.
    void lost_packets(std::optional<std::uint64_t> packets) { figures_.lost_packets = packets; }
    /// As a check found it; nothing where none did.
    void projector_off(std::optional<double> off_mm) { figures_.projector_off_mm = off_mm; }
    void restart(const std::string& what) { ++figures_.restarts[what]; }
    /// Once a loop: says the line once a minute. The machine is read for it, and once a second for the page.
    /// `stages` may be null.
    void tick(Time now, const std::string& state, double frame_rate_hz, const StageTimes* stages);
    const HealthFigures& figures() const { return figures_; }

  private:
    HealthFigures figures_, at_last_line_;
    std::optional<std::uint64_t> last_frame_us_;
    Time read_at_, line_at_;
    std::optional<HealthPage> page_;
};

}  // namespace touchstone
