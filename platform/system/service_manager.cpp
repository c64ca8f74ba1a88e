#include "platform/system/service_manager.hpp"

#include <systemd/sd-daemon.h>

namespace touchstone {

namespace {

constexpr std::chrono::seconds longer{60}, extend_every{15};

}  // namespace

ServiceManager::ServiceManager() {
    std::uint64_t span_us = 0;
    if (sd_watchdog_enabled(0, &span_us) > 0) watchdog_ = std::chrono::microseconds(span_us);
}

void ServiceManager::ready() {
    if (ready_) return;
    ready_ = true;
    send("READY=1");
}

void ServiceManager::still_starting(Clock::time_point now) {
    if (ready_ || (extended_ != Clock::time_point{} && now - extended_ < extend_every)) return;
    extended_ = now;
    send("EXTEND_TIMEOUT_USEC=" +
         std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(longer).count()));
}

void ServiceManager::progress(Clock::time_point now) {
    if (watchdog_ == Clock::duration::zero() || now - fed_ < watchdog_ / 4) return;
    fed_ = now;
    send("WATCHDOG=1");
}

void ServiceManager::status(const std::string& text) {
    if (text == status_) return;
    status_ = text;
    send("STATUS=" + text);
}

void ServiceManager::stopping() { send("STOPPING=1"); }

/// A manager that does not listen is no reason to stop.
void ServiceManager::send(const std::string& message) const { (void)sd_notify(0, message.c_str()); }

}  // namespace touchstone
