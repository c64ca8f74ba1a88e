#pragma once

#include <atomic>

#include "platform/system/service_manager.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// Tells systemd how the two loops do. It is ready once a frame of the camera went through, and its watchdog
/// is fed by the steps of the perception loop alone, while the display's loop goes on as well: never by a
/// timer.
class ServiceWatch {
  public:
    using Clock = ServiceManager::Clock;

    /// The perception loop has made a step; called by its thread.
    void perceived(const TableFrame& frame, Clock::time_point now = Clock::now());
    /// The display's loop goes on; called by its thread.
    void presented(Clock::time_point now = Clock::now()) { presented_ = now.time_since_epoch().count(); }
    void stopping() { manager_.stopping(); }

  private:
    /// A picture may take so long, on a slow screen or one that is made anew.
    static constexpr std::chrono::seconds slowest_picture{10};

    ServiceManager manager_;
    std::atomic<Clock::rep> presented_{Clock::now().time_since_epoch().count()};
};

/// `systemctl status` of a frame: "live", "sensor_lost: Waiting for a depth camera to be plugged in".
std::string status_of(const TableFrame& frame);

}  // namespace touchstone
