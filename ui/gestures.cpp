#include "ui/gestures.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "ui/gesture_finger.hpp"

namespace touchstone {

using Eigen::Vector2f;

struct GestureRecognizer::Group {
    /// The drag or transform that has been told and has not ended.
    struct Open {
        std::size_t fingers;
        Vector2f origin_px;
        Vector2f place_px;  ///< of the finger, or the centroid of those in sight
    };
    int number;
    std::optional<int> target;
    std::vector<GestureFinger> fingers = {};
    std::size_t most_fingers = 0;
    bool moving = false;  ///< a finger has left the tap radius: no taps and holds any more
    std::optional<Open> open = std::nullopt;

    bool has_gone() const {
        return std::ranges::all_of(fingers,
                                   [](const GestureFinger& finger) { return finger.lifted_us.has_value(); });
    }
    Gesture gesture(std::size_t fingers_in_it, decltype(Gesture::what) what) const {
        return {number, target, static_cast<int>(fingers_in_it), std::move(what)};
    }
};

struct GestureRecognizer::RecentTap {
    std::optional<int> target;
    Vector2f place_px;
    std::uint64_t up_us;
};

GestureRecognizer::GestureRecognizer(const GestureConfig& config, HitTest hit)
    : config_(config), hit_(std::move(hit)) {}

GestureRecognizer::~GestureRecognizer() = default;

void GestureRecognizer::on_touch(const TouchEvent& event, std::uint64_t timestamp_us) {
    if (timestamp_us > now_us_ && !frame_.empty()) step();
    now_us_ = std::max(now_us_, timestamp_us);
    frame_.push_back(event);
}

std::vector<Gesture> GestureRecognizer::update(std::uint64_t now_us) {
    if (!frame_.empty()) step();
    if (now_us > now_us_) {
        now_us_ = now_us;
        step();
    }
    return std::exchange(told_, {});
}

std::vector<Gesture> GestureRecognizer::cancel() {
    for (Group& group : groups_) tell_end(group, true);
    groups_.clear();
    recent_taps_.clear();
    frame_.clear();
    return std::exchange(told_, {});
}

/// One frame, or time alone. Fingers that go on come before those that are new, and ups before the downs that
/// may bridge them, whatever the order of the events: a new finger then finds the others in their new places.
void GestureRecognizer::step() {
    end_missing();
    const std::vector<TouchEvent> events = std::exchange(frame_, {});
    std::vector<TouchEvent> others, news;
    for (const TouchEvent& event : events) {
        GestureFinger* finger = event.phase == TouchPhase::up ? touching(event.tip.id) : nullptr;
        finger ? finger->lift(now_us_, config_) : others.push_back(event);
    }
    for (const TouchEvent& event : others)
        if (!go_on(event)) news.push_back(event);
    tell_progress();
    for (const TouchEvent& event : news) come_down(event);
    tell_progress();
}

/// False where it is not the event of a finger that was there before.
bool GestureRecognizer::go_on(const TouchEvent& event) {
    if (event.phase == TouchPhase::up) return false;
    GestureFinger* finger = touching(event.tip.id);
    if (!finger) return event.phase == TouchPhase::down && bridge(event);
    finger->hidden = event.tip.state == FingerState::hidden;
    if (!finger->hidden) finger->move(event.tip.pixel_px, now_us_, config_);
    return true;
}

void GestureRecognizer::come_down(const TouchEvent& event) {
    if (event.phase == TouchPhase::up) {
        if (GestureFinger* finger = touching(event.tip.id)) finger->lift(now_us_, config_);
    } else if (!go_on(event) && event.phase == TouchPhase::down) {
        const Vector2f place_px = event.tip.pixel_px;
        Group& group = group_at(hit_ ? hit_(place_px) : std::nullopt, place_px);
        group.fingers.push_back({.id = event.tip.id, .down_us = now_us_, .place_px = place_px});
        group.most_fingers = std::max(group.most_fingers, group.fingers.size());
    }
}

/// Takes a finger that comes down for the one that dropped out nearest to it, or to its way since.
bool GestureRecognizer::bridge(const TouchEvent& event) {
    GestureFinger* nearest = nullptr;
    float nearest_px = px(config_.bridge_radius_mm);
    for (Group& group : groups_) {
        for (GestureFinger& finger : group.fingers) {
            if (!finger.lifted_us) continue;
            const float distance_px = finger.distance_to_way_px(event.tip.pixel_px, now_us_);
            if (distance_px > nearest_px) continue;
            nearest = &finger;
            nearest_px = distance_px;
        }
    }
    if (!nearest) return false;
    nearest->id = event.tip.id;
    nearest->lifted_us.reset();
    nearest->hidden = false;
    nearest->move(event.tip.pixel_px, now_us_, config_);
    return true;
}

/// Null for an id that is not in contact.
GestureFinger* GestureRecognizer::touching(int id) {
    for (Group& group : groups_)
        for (GestureFinger& finger : group.fingers)
            if (finger.id == id && !finger.lifted_us) return &finger;
    return nullptr;
}

/// The group that a finger joins that comes down there; a new one where there is none.
GestureRecognizer::Group& GestureRecognizer::group_at(const std::optional<int>& target,
                                                      const Vector2f& place_px) {
    Group* nearest = nullptr;
    float nearest_px = target ? std::numeric_limits<float>::max() : px(config_.join_mm);
    for (Group& group : groups_) {
        if (group.target != target) continue;
        // Where only fingers were that have gone, the new one does not join them: they have ended.
        if (target && group.has_gone())
            while (!group.fingers.empty()) end_finger(group, 0);
        for (const GestureFinger& finger : group.fingers) {
            const float distance_px = (finger.place_px - place_px).norm();
            if (finger.lifted_us || distance_px > nearest_px) continue;
            nearest = &group;
            nearest_px = distance_px;
        }
    }
    return nearest ? *nearest : groups_.emplace_back(Group{.number = groups_made_++, .target = target});
}

void GestureRecognizer::end_missing() {
    const auto is_missing = [&](const GestureFinger& finger) {
        return finger.lifted_us && now_us_ > *finger.lifted_us + config_.bridge_us;
    };
    for (Group& group : groups_)
        for (std::size_t i = 0; i < group.fingers.size();)
            is_missing(group.fingers[i]) ? end_finger(group, i) : void(++i);
    std::erase_if(groups_, [](const Group& group) { return group.fingers.empty(); });
    // The second tap is told a whole tap and a bridged gap after its down.
    const std::uint64_t kept_us = config_.double_tap_us + config_.hold_us + 2 * config_.bridge_us;
    std::erase_if(recent_taps_, [&](const RecentTap& tap) { return now_us_ > tap.up_us + kept_us; });
}

void GestureRecognizer::end_finger(Group& group, std::size_t index) {
    const GestureFinger finger = group.fingers[index];
    group.fingers.erase(group.fingers.begin() + static_cast<std::ptrdiff_t>(index));
    if (!group.moving && !finger.held) tell_tap(group, finger);
    if (!group.open) return;
    const Group::Open ended = *group.open;
    tell_end(group, false);
    const Vector2f total_px = ended.place_px - ended.origin_px;
    if (ended.fingers == 1 && total_px.norm() >= px(config_.swipe_length_mm) &&
        finger.lift_velocity_px_s.norm() >= px(config_.swipe_speed_mm_s))
        told_.push_back(group.gesture(1, Swipe{ended.place_px, total_px, finger.lift_velocity_px_s}));
}

void GestureRecognizer::tell_progress() {
    for (Group& group : groups_) {
        tell_holds(group);
        group.moving = group.moving || std::ranges::any_of(group.fingers, &GestureFinger::has_left);
        if (group.moving) tell_motion(group);
    }
}

void GestureRecognizer::tell_holds(Group& group) {
    if (group.moving) return;
    for (GestureFinger& finger : group.fingers) {
        const std::uint64_t until_us = finger.lifted_us.value_or(now_us_);
        if (finger.held || finger.has_left || until_us < finger.down_us + config_.hold_us) continue;
        finger.held = true;
        told_.push_back(group.gesture(group.most_fingers, Hold{finger.rest_px}));
    }
}

void GestureRecognizer::tell_tap(const Group& group, const GestureFinger& finger) {
    const auto first = std::ranges::find_if(recent_taps_, [&](const RecentTap& tap) {
        return tap.target == group.target && finger.down_us >= tap.up_us &&
               finger.down_us - tap.up_us <= config_.double_tap_us &&
               (finger.rest_px - tap.place_px).norm() <= px(config_.double_tap_radius_mm);
    });
    if (first != recent_taps_.end()) {
        recent_taps_.erase(first);
        told_.push_back(group.gesture(group.most_fingers, DoubleTap{finger.rest_px}));
    } else {
        recent_taps_.push_back({group.target, finger.rest_px, *finger.lifted_us});
        told_.push_back(group.gesture(group.most_fingers, Tap{finger.rest_px}));
    }
}

/// What the fingers in sight did since it was told last. The others are taken along, so that one that comes
/// back only adds what it did differently.
void GestureRecognizer::tell_motion(Group& group) {
    const std::size_t count = group.fingers.size();
    if (group.open && group.open->fingers != count) tell_end(group, false);
    std::vector<Vector2f> from_px, to_px;
    for (const GestureFinger& finger : group.fingers) {
        if (!finger.in_sight()) continue;
        from_px.push_back(finger.told_px);
        to_px.push_back(finger.place_px);
    }
    if (from_px.empty() || (group.open && from_px == to_px)) return;
    const Similarity delta = fit_similarity(from_px, to_px);
    for (GestureFinger& finger : group.fingers) {
        if (!finger.in_sight()) finger.place_px = delta(finger.told_px);
        finger.told_px = finger.place_px;
    }
    const GesturePhase phase = group.open ? GesturePhase::change : GesturePhase::begin;
    if (!group.open) group.open = {count, delta.center_px, delta.center_px};
    Group::Open& open = *group.open;
    open.place_px = delta.center_px + delta.translation_px;
    if (count == 1)
        told_.push_back(group.gesture(
            1, Drag{phase, open.place_px, open.place_px - open.origin_px, delta.translation_px}));
    else
        told_.push_back(group.gesture(count, Transform{phase, delta}));
}

void GestureRecognizer::tell_end(Group& group, bool cancelled) {
    if (!group.open) return;
    const auto [count, origin_px, place_px] = *group.open;
    group.open.reset();
    if (count == 1) {
        const Drag end{GesturePhase::end, place_px, place_px - origin_px, {0.f, 0.f}, cancelled};
        told_.push_back(group.gesture(count, end));
    } else {
        Transform end{GesturePhase::end, {}, cancelled};
        end.delta.center_px = place_px;
        told_.push_back(group.gesture(count, end));
    }
}

}  // namespace touchstone
