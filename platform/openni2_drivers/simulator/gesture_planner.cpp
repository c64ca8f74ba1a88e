#include "platform/openni2_drivers/simulator/gesture_planner.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone::sim {
namespace {

constexpr float mm = 1e-3F;
constexpr int tries = 60;

HandPosture shifted(HandPosture posture, const Vec3& by) {
    posture.index_tip += by;
    posture.thumb_tip += by;
    return posture;
}

/// Appends a motion that starts where and when the last one ends.
Motion& append(std::vector<Motion>& motions, Motion::Kind kind, const HandPosture& from,
               const HandPosture& to, double start_s, double length_s, bool thumb_touches) {
    const double start = motions.empty() ? start_s : motions.back().end_s;
    motions.push_back({kind, start, start + length_s, from, to, 0.0F, 0.0F, 0.0F, thumb_touches});
    return motions.back();
}

/// A point of the scene that the camera sees; every second one lies on a thing, where there is one.
Vec3 draw_goal(const Workplace& place, Random& random) {
    const bool on_thing = random.chance(0.5F);
    Vec3 goal;
    for (int attempt = 0; attempt < 20; ++attempt) {
        const int u = 40 + random.below(560);
        const int v = 40 + random.below(400);
        const float z = place.depth_m[static_cast<std::size_t>(v * place.view.intrinsics.width_px + u)];
        goal = place.view.to_scene(place.view.ray_c(static_cast<float>(u), static_cast<float>(v)) * z);
        if (!on_thing || place.scene.nearest(goal) >= 0) break;
    }
    return goal;
}

/// Of a strike or a lift.
double strike_s(Random& random) { return random.uniform(0.09F, 0.17F); }

}  // namespace

double GesturePlanner::contact_s(Random& random) const {
    if (!human_timing_) return random.uniform(0.15F, 0.3F);
    // Two half log-normals that meet at the median: p5/p50/p95 = 36/76/230 ms (field/touch.md, fact 4).
    const float z = random.normal();
    return std::clamp(0.076F * std::exp((z < 0.0F ? 0.454F : 0.673F) * z), 0.015F, 0.6F);
}

float GesturePlanner::planned_gap_m(Gesture gesture, Random& random) const {
    if (hover_) return random.uniform(hover_->least_m, hover_->most_m);
    if (gesture == Gesture::sweep) return random.uniform(15.0F, 80.0F) * mm;
    if (gesture == Gesture::feint) return random.uniform(13.0F, 30.0F) * mm;
    return random.uniform(0.0F, 0.15F) * mm;
}

bool GesturePlanner::is_high_enough(const Hand& hand) const {
    constexpr float rounding_m = 1e-4F;
    return !hover_ ||
           gap_m(place_.scene, hand.index().a, hand.index().radius_a) > hover_->least_m - rounding_m;
}

bool GesturePlanner::can_rest(const HandPosture& posture, const Vec3& shoulder_s, bool thumb_touches) const {
    const Hand hand = build_hand(shape_, posture, shoulder_s, thumb_touches);
    return is_clear(hand, place_) && is_tip_visible(hand, 0, place_) &&
           (!thumb_touches || is_tip_visible(hand, 1, place_));
}

std::optional<HandPosture> GesturePlanner::aim(Gesture gesture, const std::optional<Vec3>& goal_s,
                                               float gap_m, const Vec3& shoulder_s, Random& random) const {
    const Vec3 goal = goal_s ? *goal_s : draw_goal(place_, random);
    const Vec3 way = goal - shoulder_s;
    if (way.head<2>().norm() > 0.8F || way.head<2>().norm() < 0.26F) return std::nullopt;
    if (place_.half != 0.0F && place_.half * goal.x() < 0.05F) return std::nullopt;
    const bool pinch = gesture == Gesture::pinch;
    HandPosture posture;
    posture.yaw_rad = std::atan2(way.y(), way.x()) + radians(12.0F) * random.normal();
    posture.pitch_rad = radians(pinch ? random.uniform(36.0F, 60.0F) : random.uniform(30.0F, 60.0F));
    posture.bend_rad = radians(random.uniform(4.0F, 22.0F));
    posture.curl = random.chance(0.65F) ? random.uniform(0.85F, 1.0F) : random.uniform(0.0F, 0.3F);
    const float radius = shape_.fingertip_radius_m + gap_m;
    posture.index_tip = {goal.x(), goal.y(), place_.scene.resting_height_m(goal.x(), goal.y(), radius)};
    if (place_.scene.normal(posture.index_tip).z() < 0.62F) return std::nullopt;
    posture.thumb_tip = relaxed_thumb_tip(shape_, posture);
    if (pinch && !aim_thumb(posture, gap_m, shoulder_s, random)) return std::nullopt;
    if (!can_rest(posture, shoulder_s, pinch)) return std::nullopt;
    return posture;
}

bool GesturePlanner::aim_thumb(HandPosture& posture, float gap_m, const Vec3& shoulder_s,
                               Random& random) const {
    const float apart_m = random.uniform(34.0F, 85.0F) * mm;
    // From the index's tip back towards the hand and to the thumb's side.
    const float heading =
        posture.yaw_rad + std::numbers::pi_v<float> - shape_.side * radians(random.uniform(30.0F, 75.0F));
    posture.thumb_tip = posture.index_tip + apart_m * pointing(heading, 0.0F);
    posture.thumb_tip.z() = place_.scene.resting_height_m(posture.thumb_tip.x(), posture.thumb_tip.y(),
                                                          thumb_radius_m(shape_) + gap_m);
    const Hand hand = build_hand(shape_, posture, shoulder_s, true);
    return (hand.thumb().a - posture.thumb_tip).norm() < 1e-5F &&
           place_.scene.normal(posture.thumb_tip).z() > 0.62F;
}

std::optional<HandPosture> GesturePlanner::move_on(Gesture gesture, const HandPosture& from, float gap_m,
                                                   Random& random) const {
    const bool pinch = gesture == Gesture::pinch;
    const float far_m = pinch ? random.uniform(0.0F, 0.08F) : random.uniform(0.05F, 0.3F);
    HandPosture to = shifted(from, far_m * pointing(random.uniform(0.0F, 6.283F), 0.0F));
    const float aperture = pinch ? random.uniform(0.55F, 1.7F) : 1.0F;
    to.thumb_tip = to.index_tip + aperture * (from.thumb_tip - from.index_tip);
    if (pinch && (to.thumb_tip - to.index_tip).norm() < 0.03F) return std::nullopt;
    const auto rest = [&](Vec3& tip, float radius) {
        tip.z() = place_.scene.resting_height_m(tip.x(), tip.y(), radius + gap_m);
    };
    const float before_z = to.index_tip.z();
    rest(to.index_tip, shape_.fingertip_radius_m);
    if (pinch)
        rest(to.thumb_tip, thumb_radius_m(shape_));
    else
        to.thumb_tip.z() += to.index_tip.z() - before_z;
    return to;
}

bool GesturePlanner::is_possible(const Motion& motion, const Vec3& shoulder_s) const {
    return is_possible(motion, shoulder_s, 0.03) && is_possible(motion, shoulder_s, 0.005);
}

bool GesturePlanner::is_possible(const Motion& motion, const Vec3& shoulder_s, double step_s) const {
    const bool trace = motion.kind == Motion::Kind::trace;
    const double length_s = motion.end_s - motion.start_s;
    const int samples =
        motion.kind == Motion::Kind::rest ? 1 : std::max(4, static_cast<int>(length_s / step_s));
    Vec3 before = motion.from.index_tip;
    for (int i = 0; i <= samples; ++i) {
        const double time_s = motion.start_s + length_s * i / samples;
        const HandPosture posture = posture_at(motion, time_s, place_.scene, shape_);
        const Hand hand = build_hand(shape_, posture, shoulder_s, motion.thumb_touches);
        if (!is_clear(hand, place_) || !is_high_enough(hand)) return false;
        if (!trace) continue;
        if (!is_tip_visible(hand, 0, place_) || (motion.thumb_touches && !is_tip_visible(hand, 1, place_)))
            return false;
        if (motion.thumb_touches && (hand.thumb().a - posture.thumb_tip).norm() > 1e-5F) return false;
        const Vec3 step = posture.index_tip - before;
        if (std::abs(step.z()) > 1.5F * step.head<2>().norm() + 0.3F * mm) return false;
        before = posture.index_tip;
    }
    return true;
}

std::vector<Motion> GesturePlanner::glide(const HandPosture& from, const HandPosture& to, double start_s,
                                          const Vec3& shoulder_s) const {
    const float far_m = (to.index_tip - from.index_tip).norm();
    for (const float arch_m : {0.0F, 0.04F, 0.09F, 0.15F, 0.22F}) {
        Motion motion{Motion::Kind::glide,
                      start_s,
                      start_s + 0.24 + 0.85 * static_cast<double>(far_m + arch_m),
                      from,
                      to,
                      arch_m,
                      0.0F,
                      0.0F,
                      false};
        if (is_possible(motion, shoulder_s)) return {motion};
    }
    return {};
}

std::vector<Motion> GesturePlanner::still_contact(Gesture gesture, const Target& target, double start_s,
                                                  Random& random) const {
    using Kind = Motion::Kind;
    const auto& [at, over, gap_m] = target;
    const int taps = gesture == Gesture::tap && random.chance(0.25F) ? 2 + random.below(2) : 1;
    const Vec3 away = over.index_tip - at.index_tip;
    std::vector<Motion> motions;
    HandPosture from = over;
    for (int i = 0; i < taps; ++i) {
        append(motions, Kind::strike, from, at, start_s, strike_s(random), false);
        const double hold_s = gesture == Gesture::hold    ? random.uniform(0.5F, 2.0F)
                              : gesture == Gesture::feint ? random.uniform(0.0F, 0.25F)
                                                          : contact_s(random);
        append(motions, Kind::rest, at, at, start_s, hold_s, false);
        from = i + 1 < taps ? shifted(at, away * random.uniform(0.3F, 0.8F)) : over;
        append(motions, Kind::lift, at, from, start_s, strike_s(random), false);
    }
    return motions;
}

std::vector<Motion> GesturePlanner::moving_contact(Gesture gesture, const Target& target, double start_s,
                                                   Random& random) const {
    using Kind = Motion::Kind;
    const auto& [at, over, gap_m] = target;
    const bool pinch = gesture == Gesture::pinch;
    const bool sweep = gesture == Gesture::sweep;
    const auto to = move_on(gesture, at, gap_m, random);
    if (!to) return {};
    std::vector<Motion> motions;
    if (!sweep) {
        append(motions, Kind::strike, over, at, start_s, strike_s(random), pinch);
        append(motions, Kind::rest, at, at, start_s, contact_s(random), pinch);
    }
    const float way_m = std::max(0.03F, (to->index_tip - at.index_tip).norm());
    // A minimum-jerk way is at most 1.9 times as fast as its mean: 0.5 m/s.
    Motion& trace =
        append(motions, Kind::trace, at, *to, start_s, way_m / random.uniform(0.08F, 0.26F), pinch);
    trace.gap_m = gap_m;
    trace.bow_m = random.uniform(-0.2F, 0.2F) * way_m;
    if (!sweep) {
        append(motions, Kind::rest, *to, *to, start_s, random.uniform(0.02F, 0.1F), pinch);
        const HandPosture up = shifted(*to, over.index_tip - at.index_tip);
        append(motions, Kind::lift, *to, up, start_s, strike_s(random), pinch);
    }
    return motions;
}

std::vector<Motion> GesturePlanner::try_gesture(Gesture gesture, const std::optional<Vec3>& goal_s,
                                                const HandPosture& now, double start_s,
                                                const Vec3& shoulder_s, Random& random) const {
    const bool pinch = gesture == Gesture::pinch;
    const float gap_m = planned_gap_m(gesture, random);
    const auto at = aim(gesture, goal_s, gap_m, shoulder_s, random);
    if (!at) return {};
    const Vec3 away = (place_.scene.normal(at->index_tip) + Vec3::UnitZ()).normalized();
    const HandPosture over =
        gesture == Gesture::sweep ? *at : shifted(*at, away * random.uniform(20.0F, 60.0F) * mm);
    std::vector<Motion> motions = glide(now, over, start_s, shoulder_s);
    if (motions.empty()) return {};
    motions.back().thumb_touches = pinch;
    append(motions, Motion::Kind::rest, over, over, start_s, random.uniform(0.0F, 0.12F), pinch);
    const bool moves = gesture == Gesture::drag || gesture == Gesture::sweep || pinch;
    const auto plan_contact = moves ? &GesturePlanner::moving_contact : &GesturePlanner::still_contact;
    const std::vector<Motion> contact =
        (this->*plan_contact)(gesture, {*at, over, gap_m}, motions.back().end_s, random);
    const auto possible = [&](const Motion& motion) { return is_possible(motion, shoulder_s); };
    if (contact.empty() || !std::all_of(contact.begin(), contact.end(), possible)) return {};
    motions.insert(motions.end(), contact.begin(), contact.end());
    return motions;
}

std::vector<Motion> GesturePlanner::plan(Gesture gesture, const HandPosture& now, double start_s,
                                         const Vec3& shoulder_s, Random& random) const {
    for (int i = 0; i < tries; ++i) {
        std::vector<Motion> motions = try_gesture(gesture, std::nullopt, now, start_s, shoulder_s, random);
        if (!motions.empty()) return motions;
    }
    return {};
}

std::vector<Motion> GesturePlanner::plan_touch(const Vec3& place_s, const HandPosture& now, double start_s,
                                               const Vec3& shoulder_s, Random& random) const {
    // The tip's middle, so that the tip touches there, on a slope too.
    const Vec3 tip_s = place_s + shape_.fingertip_radius_m * place_.scene.normal(place_s);
    for (int i = 0; i < tries; ++i) {
        std::vector<Motion> motions = try_gesture(Gesture::hold, tip_s, now, start_s, shoulder_s, random);
        if (!motions.empty()) return motions;
    }
    return {};
}

}  // namespace touchstone::sim
