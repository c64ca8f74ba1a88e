#pragma once

#include <chrono>
#include <string>

namespace touchstone {

/// What systemd is told of a program that it started as Type=notify; nothing where it did not.
class ServiceManager {
  public:
    using Clock = std::chrono::steady_clock;

    /// Looks at NOTIFY_SOCKET and WATCHDOG_USEC.
    ServiceManager();

    /// The start is over; only the first call counts.
    void ready();
    bool is_ready() const { return ready_; }
    /// The start takes longer, for a reason: it is given another minute from now on. Not once ready() was
    /// called.
    void still_starting(Clock::time_point now);
    /// The work goes on. Feeds the watchdog, four times in its span where it is called as often.
    void progress(Clock::time_point now);
    /// One line for `systemctl status`; the same again is not sent.
    void status(const std::string& text);
    void stopping();

  private:
    void send(const std::string& message) const;

    Clock::duration watchdog_{};  ///< zero: there is none
    Clock::time_point fed_{}, extended_{};
    std::string status_;
    bool ready_ = false;
};

}  // namespace touchstone
