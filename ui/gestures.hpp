#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "pipeline/touch_event.hpp"
#include "ui/similarity.hpp"

namespace touchstone {

enum class GesturePhase { begin, change, end };

/// Down and up within the tap radius and before a hold. Told when the finger has been up for `bridge_us`:
/// until then it may come back.
struct Tap {
    Eigen::Vector2f place_px{0.f, 0.f};
};

/// The second of two taps, told in place of a Tap. The first was told as a Tap.
struct DoubleTap {
    Eigen::Vector2f place_px{0.f, 0.f};
};

/// Down for `hold_us` within the tap radius; told while the finger is down. It may still go on to a drag.
struct Hold {
    Eigen::Vector2f place_px{0.f, 0.f};
};

/// One finger that has left the tap radius. The first change already comes with `begin`, so that what is
/// dragged stays under the finger and the deltas sum up to the total.
struct Drag {
    GesturePhase phase = GesturePhase::begin;
    Eigen::Vector2f place_px{0.f, 0.f};
    Eigen::Vector2f total_px{0.f, 0.f};  ///< from where the finger came down, or became the last of several
    Eigen::Vector2f delta_px{0.f, 0.f};  ///< since what was told last; none with `end`
    bool cancelled = false;              ///< with `end`: by cancel(), not by the finger
};

/// A drag that ended fast, told after its end.
struct Swipe {
    Eigen::Vector2f place_px{0.f, 0.f};  ///< where the finger left the surface
    Eigen::Vector2f total_px{0.f, 0.f};
    Eigen::Vector2f velocity_px_s{0.f, 0.f};
};

/// Two or more fingers of which one has left the tap radius.
struct Transform {
    GesturePhase phase = GesturePhase::begin;
    /// Since what was told last, about the fingers' centroid then; none with `end`.
    Similarity delta;
    bool cancelled = false;  ///< with `end`: by cancel(), not by a finger
};

/// A gesture of the fingers on one target, or of one group of fingers on the background. A drag or transform
/// has the same number of fingers from begin to end: when one joins or leaves, it ends and another begins.
struct Gesture {
    int group = 0;              ///< the same as long as one of its fingers is down, then never again
    std::optional<int> target;  ///< as hit where the group's first finger came down; none: the background
    int fingers = 1;            ///< Tap, DoubleTap, Hold: the most that the group had at once
    std::variant<Tap, DoubleTap, Hold, Drag, Swipe, Transform> what;
};

/// Lengths are millimetres on the surface.
struct GestureConfig {
    /// Of the depth picture at the surface: a Kinect a metre above the table.
    float mm_per_px = 1.7f;
    /// Four times the jitter of a resting finger (2 mm), half a fingertip.
    float tap_radius_mm = 8.f;
    /// Longer than nearly every tap (0.05 to 0.3 s), short enough to wait for.
    std::uint64_t hold_us = 600'000;
    /// From the first tap's up to the second's down. A gap of less than bridge_us is a drop-out, not a second
    /// tap.
    std::uint64_t double_tap_us = 400'000;
    /// Between two taps: people hit the same spot again to about a fingertip.
    float double_tap_radius_mm = 20.f;
    /// The longest drop-out of a touch: two frames at 30 Hz, with room for their jitter.
    std::uint64_t bridge_us = 80'000;
    /// From the place, or the way, of a finger that dropped out: less than two fingers side by side (20 mm).
    float bridge_radius_mm = 15.f;
    /// Speed over the last `velocity_us`: ten times what jitter feigns; careful drags stay below it.
    float swipe_speed_mm_s = 300.f;
    /// A shorter drag is no swipe, however fast.
    float swipe_length_mm = 30.f;
    /// Three or four frames at 30 Hz.
    std::uint64_t velocity_us = 100'000;
    /// On the background, a finger joins the group that has a finger this near when it comes down: the span
    /// of an adult's hand. Groups never merge or split later, so a pinch may open further.
    float join_mm = 230.f;
};

/// The target at a place of the depth picture; none for the background.
using HitTest = std::function<std::optional<int>(const Eigen::Vector2f& place_px)>;

struct GestureFinger;

/// Turns touches into gestures. Fingers on one target make one gesture, on the background those of one hand.
/// A finger that drops out and comes back, also with a new id, is still the same; while it is not seen the
/// others move on without it, and it is taken to have moved with them. Fingers whose down was not told are
/// ignored. The same calls give the same gestures: there is no clock but the timestamps.
class GestureRecognizer {
  public:
    /// `hit` is asked once for each finger, when it comes down; without one all is background.
    explicit GestureRecognizer(const GestureConfig& config, HitTest hit = {});
    ~GestureRecognizer();
    GestureRecognizer(const GestureRecognizer&) = delete;
    GestureRecognizer& operator=(const GestureRecognizer&) = delete;

    /// Events of one timestamp are one frame and may come in any order of the fingers. A time before the last
    /// one counts as that.
    void on_touch(const TouchEvent& event, std::uint64_t timestamp_us);
    /// Ends the frame and moves time on, for holds, ups and drop-outs; what was recognised since the last
    /// call.
    std::vector<Gesture> update(std::uint64_t now_us);
    /// When nobody can touch any more: ends what is open, cancelled, and forgets all fingers and taps.
    std::vector<Gesture> cancel();

  private:
    struct Group;
    struct RecentTap;

    void step();
    bool go_on(const TouchEvent& event);
    void come_down(const TouchEvent& event);
    bool bridge(const TouchEvent& event);
    GestureFinger* touching(int id);
    Group& group_at(const std::optional<int>& target, const Eigen::Vector2f& place_px);
    void end_missing();
    void end_finger(Group& group, std::size_t index);
    void tell_progress();
    void tell_holds(Group& group);
    void tell_tap(const Group& group, const GestureFinger& finger);
    void tell_motion(Group& group);
    void tell_end(Group& group, bool cancelled);
    float px(float length_mm) const { return length_mm / config_.mm_per_px; }

    GestureConfig config_;
    HitTest hit_;
    std::uint64_t now_us_ = 0;
    int groups_made_ = 0;
    std::vector<TouchEvent> frame_;  // of now_us_, not yet looked at
    std::vector<Group> groups_;
    std::vector<RecentTap> recent_taps_;
    std::vector<Gesture> told_;
};

}  // namespace touchstone
