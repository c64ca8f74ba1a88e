#pragma once

#include <algorithm>
#include <cstdint>

#include "ui/table_frame.hpp"

namespace touchstone {

/// Notices that nobody has touched or hovered for a while, by the frames' time.
class IdleWatch {
  public:
    /// 0: never.
    explicit IdleWatch(float after_s) : after_us_(static_cast<std::uint64_t>(1e6 * double{after_s})) {}

    /// A new frame. What is not live, and calibration, count as somebody there.
    void see(const TableFrame& frame) {
        const bool somebody =
            !frame.touches.empty() || !frame.hovers.empty() || frame.state != "live" || frame.cross;
        if (somebody || !has_seen_ || frame.timestamp_us < active_us_) active_us_ = frame.timestamp_us;
        has_seen_ = true;
        is_idle_ = after_us_ > 0 && frame.timestamp_us - active_us_ >= after_us_;
    }
    bool is_idle() const { return is_idle_; }

  private:
    std::uint64_t after_us_, active_us_ = 0;
    bool has_seen_ = false, is_idle_ = false;
};

}  // namespace touchstone
