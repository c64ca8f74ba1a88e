#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "platform/output/contact_follower.hpp"
#include "platform/output/touch_sink.hpp"
#include "platform/output/tuio_bundle.hpp"

namespace touchstone {

/// Where the two counters of a process start, both in 1..2^31-1.
struct TuioStart {
    std::int32_t fseq = 1;
    std::int32_t session = 1;
};

/// Counters that follow the clock so fast that no process can overtake them: a restarted one starts above.
TuioStart tuio_start(std::chrono::system_clock::time_point now);

/// Turns reports into the bundles that tell a TUIO 1.1 client of them. Datagrams may be lost, the client may
/// start at any time, and this process may have been killed and started anew; so
/// - every frame with touches carries all of them, and a touch is sent in two bundles at least before it
/// ends;
/// - an emptied table is said twice at once, again in the next frames, and like every state at least every
/// second;
/// - a touch that begins and ends in one report has its end in a bundle of its own;
/// - a session id is of one contact: a finger that touches again gets a new one.
/// With a unit of height, a finger is a cursor as long as it is over the surface: its session goes on when it
/// touches, where its z is 0, and when it comes up.
class TuioSession {
  public:
    using Clock = std::chrono::steady_clock;
    using Bundles = std::vector<TuioBundle>;

    /// `unit_height_mm` over the surface z is 1, and stays 1 above.
    explicit TuioSession(TuioStart start, std::optional<double> unit_height_mm = {})
        : unit_height_mm_(unit_height_mm), next_fseq_(start.fseq), follower_(start.session) {}

    /// Ends what an earlier process left, and makes every client take the frames that follow.
    Bundles start(Clock::time_point now);
    Bundles frame(const TouchReport& report, Clock::time_point now);
    /// Ends all touches. Also the last words of the process.
    Bundles release_all(Clock::time_point now);
    /// The present state again, where nothing was said for long.
    Bundles refresh(Clock::time_point now);

  private:
    struct Contact {
        TuioCursor cursor;
        std::uint64_t time_us = 0;
        double speed = 0.0;
        int bundles = 0;  ///< in which it was sent
        bool over = false;
    };
    enum class Kind { frame, repetition };

    void take_touches(const TouchReport& report);
    Contact& contact_of(std::int32_t session);
    /// A cursor that does not move.
    TuioCursor cursor_at(std::int32_t session, const ReportedFinger& finger) const;
    void move(Contact& contact, const ReportedFinger& finger, std::uint64_t time_us) const;
    void say(Bundles& out, Kind kind, Clock::time_point now);
    void say_young_contacts_that_end(Bundles& out, Clock::time_point now);

    std::optional<double> unit_height_mm_;
    std::int32_t next_fseq_;
    ContactFollower follower_;
    std::vector<Contact> contacts_;
    int empty_frames_to_say_ = 0;
    Clock::time_point last_said_{};
};

}  // namespace touchstone
