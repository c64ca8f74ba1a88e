#include "app/service_watch.hpp"

namespace touchstone {

void ServiceWatch::perceived(const TableFrame& frame, Clock::time_point now) {
    const bool has_seen = frame.arrived != std::chrono::steady_clock::time_point{};
    if (has_seen)
        manager_.ready();
    else
        manager_.still_starting(now);
    manager_.status(status_of(frame));
    const Clock::time_point presented{Clock::duration(presented_.load())};
    if (now - presented < slowest_picture) manager_.progress(now);
}

std::string status_of(const TableFrame& frame) {
    return frame.note.empty() ? frame.state : frame.state + ": " + frame.note;
}

}  // namespace touchstone
