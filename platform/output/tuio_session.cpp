#include "platform/output/tuio_session.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();
// The rule asks for a sign of life each second; the frame at which it is noticed may be 33 ms late.
constexpr std::chrono::milliseconds longest_silence{900};
constexpr int empty_frames_after_the_last_touch = 3;

// A client drops a frame that is up to 100 behind its own count: of two that lie further apart it takes one.
constexpr std::int32_t late_window = 100;

std::int32_t advanced(std::int32_t counter, std::int32_t by) {
    return counter > largest - by ? 1 : counter + by;
}

std::int32_t ticks(std::chrono::system_clock::time_point now, std::uint64_t per_second) {
    using std::chrono::duration_cast, std::chrono::microseconds;
    const auto us = static_cast<std::uint64_t>(duration_cast<microseconds>(now.time_since_epoch()).count());
    return static_cast<std::int32_t>(us * per_second / 1'000'000 % (largest - 1)) + 1;
}

float share(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

/// Touching and hovering fingers alike. One that comes up is there still: the next report has it as a hover.
std::vector<ReportedFinger> fingers_over_the_surface(const TouchReport& report) {
    std::vector<ReportedFinger> fingers = report.hovers;
    for (const ReportedFinger& touch : report.touches) {
        std::erase_if(fingers, [&](const ReportedFinger& finger) { return finger.id == touch.id; });
        fingers.push_back(touch);
        if (touch.phase != ReportedPhase::up) fingers.back().height_mm = 0.0;
    }
    for (ReportedFinger& finger : fingers) finger.phase = ReportedPhase::move;
    return fingers;
}

}  // namespace

TuioStart tuio_start(std::chrono::system_clock::time_point now) {
    return {.fseq = ticks(now, 1024), .session = ticks(now, 32)};
}

TuioSession::Bundles TuioSession::start(Clock::time_point now) {
    Bundles out;
    say(out, Kind::repetition, now);
    say(out, Kind::frame, now);
    next_fseq_ = advanced(next_fseq_, late_window);
    say(out, Kind::frame, now);
    return out;
}

TuioSession::Bundles TuioSession::frame(const TouchReport& report, Clock::time_point now) {
    Bundles out;
    take_touches(report);
    say_young_contacts_that_end(out, now);
    const auto ended = std::erase_if(contacts_, [](const Contact& c) { return c.over && c.bundles > 0; });
    if (ended > 0 || !contacts_.empty()) say(out, Kind::frame, now);
    if (std::any_of(contacts_.begin(), contacts_.end(), [](const Contact& c) { return c.over; })) {
        say(out, Kind::repetition, now);
        std::erase_if(contacts_, [](const Contact& c) { return c.over; });
        say(out, Kind::frame, now);
    }
    if (!contacts_.empty()) return out;
    if (!out.empty()) {
        say(out, Kind::repetition, now);
        empty_frames_to_say_ = empty_frames_after_the_last_touch;
    } else if (empty_frames_to_say_ > 0) {
        --empty_frames_to_say_;
        say(out, Kind::repetition, now);
    } else {
        return refresh(now);
    }
    return out;
}

TuioSession::Bundles TuioSession::release_all(Clock::time_point now) {
    Bundles out;
    follower_.end_all();
    for (Contact& contact : contacts_) contact.over = true;
    say_young_contacts_that_end(out, now);
    contacts_.clear();
    say(out, Kind::frame, now);
    say(out, Kind::repetition, now);
    return out;
}

TuioSession::Bundles TuioSession::refresh(Clock::time_point now) {
    Bundles out;
    if (now - last_said_ >= longest_silence) say(out, Kind::repetition, now);
    return out;
}

void TuioSession::take_touches(const TouchReport& report) {
    const auto fingers = unit_height_mm_ ? fingers_over_the_surface(report) : report.touches;
    for (const ContactChange& change : follower_.take(fingers)) {
        switch (change.step) {
            case ContactStep::begin:
                contacts_.push_back(
                    {.cursor = cursor_at(change.contact, change.finger), .time_us = report.time_us});
                break;
            case ContactStep::move:
                move(contact_of(change.contact), change.finger, report.time_us);
                break;
            case ContactStep::end:
                contact_of(change.contact).over = true;
                break;
        }
    }
}

TuioSession::Contact& TuioSession::contact_of(std::int32_t session) {
    return *std::ranges::find_if(contacts_, [&](const Contact& c) { return c.cursor.session == session; });
}

TuioCursor TuioSession::cursor_at(std::int32_t session, const ReportedFinger& finger) const {
    return {.session = session,
            .x = share(finger.surface[0]),
            .y = share(finger.surface[1]),
            .z = unit_height_mm_ ? share(finger.height_mm / *unit_height_mm_) : 0.f};
}

/// Takes the finger's place; velocity and acceleration follow from the place and time before.
void TuioSession::move(Contact& contact, const ReportedFinger& finger, std::uint64_t time_us) const {
    TuioCursor next = cursor_at(contact.cursor.session, finger);
    if (time_us > contact.time_us) {
        const double dt_s = static_cast<double>(time_us - contact.time_us) * 1e-6;
        const double velocity_x = (next.x - contact.cursor.x) / dt_s;
        const double velocity_y = (next.y - contact.cursor.y) / dt_s;
        const double velocity_z = (next.z - contact.cursor.z) / dt_s;
        const double speed = std::hypot(velocity_x, velocity_y, velocity_z);
        next.velocity_x = static_cast<float>(velocity_x);
        next.velocity_y = static_cast<float>(velocity_y);
        next.velocity_z = static_cast<float>(velocity_z);
        next.acceleration = static_cast<float>((speed - contact.speed) / dt_s);
        contact.speed = speed;
    }
    contact.cursor = next;
    contact.time_us = time_us;
}

/// A frame says all contacts, a repetition those that were said before.
void TuioSession::say(Bundles& out, Kind kind, Clock::time_point now) {
    TuioBundle bundle;
    for (Contact& contact : contacts_) {
        if (kind == Kind::repetition && contact.bundles == 0) continue;
        bundle.alive.push_back(contact.cursor.session);
        bundle.cursors.push_back(contact.cursor);
        ++contact.bundles;
    }
    if (kind == Kind::frame) {
        bundle.fseq = next_fseq_;
        next_fseq_ = advanced(next_fseq_, 1);
    }
    last_said_ = now;
    out.push_back(std::move(bundle));
}

/// A touch of one frame whose datagram was lost would otherwise never have been.
void TuioSession::say_young_contacts_that_end(Bundles& out, Clock::time_point now) {
    const bool some = std::any_of(contacts_.begin(), contacts_.end(),
                                  [](const Contact& c) { return c.over && c.bundles == 1; });
    if (some) say(out, Kind::repetition, now);
}

}  // namespace touchstone
