#include "platform/openni2_drivers/simulator/hand_script.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace touchstone::sim {
namespace {

/// -1 left, +1 right. The elbow points outward, so that a hand with its own half keeps out of the other.
float draw_side(float half, Random& random) {
    return half != 0.0F ? half : random.chance(0.7F) ? 1.0F : -1.0F;
}

struct Edge {
    Vec3 at_table_s;  ///< where the arm crosses the picture's edge, on the table
    Vec3 outward;     ///< away from the picture
};

/// Most people stand at the edge nearest to the camera's foot.
Edge draw_edge(const Workplace& place, Random& random) {
    const float draw = random.uniform();
    if (draw < 0.65F) {
        const float u = place.half == 0.0F  ? random.uniform(160.0F, 480.0F)
                        : place.half < 0.0F ? random.uniform(90.0F, 230.0F)
                                            : random.uniform(410.0F, 550.0F);
        return {place.view.on_table(u, 479.0F), -Vec3::UnitY()};
    }
    // The far edge is a person's place only where it is as near as that.
    const Edge far{place.view.on_table(random.uniform(200.0F, 440.0F), 0.0F), Vec3::UnitY()};
    if (place.half == 0.0F && draw > 0.88F && far.at_table_s.y() < 1.0F) return far;
    const bool left = place.half < 0.0F || (place.half == 0.0F && random.chance(0.5F));
    return {place.view.on_table(left ? 0.0F : 639.0F, random.uniform(190.0F, 400.0F)),
            (left ? -1.0F : 1.0F) * Vec3::UnitX()};
}

Gesture draw_gesture(Gestures gestures, Random& random) {
    using enum Gesture;
    if (gestures != Gestures::all) return random.chance(0.5F) ? sweep : feint;
    constexpr std::array<std::pair<float, Gesture>, 6> shares{
        {{0.44F, tap}, {0.55F, hold}, {0.73F, drag}, {0.87F, pinch}, {0.94F, sweep}, {1.0F, feint}}};
    const float draw = random.uniform();
    for (const auto& [until, gesture] : shares)
        if (draw < until) return gesture;
    return tap;
}

std::optional<HoverBand> hover_band(Gestures gestures) {
    if (gestures == Gestures::all) return std::nullopt;
    return gestures == Gestures::hover ? HoverBand{0.015F, 0.2F} : HoverBand{0.002F, 0.02F};
}

/// From numbers of its own: what a hand wears changes no other draw.
float sleeve_mm(const SimulatorConfig& config, int hand) {
    constexpr float tight_mm = 1.0F, loose_mm = 8.0F;
    if (config.sleeve == Sleeve::tight) return tight_mm;
    if (config.sleeve == Sleeve::loose) return loose_mm;
    Random random(config.seed, 0x51ee7e + static_cast<std::uint64_t>(hand));
    return random.chance(0.5F) ? tight_mm : random.uniform(6.0F, 12.0F);
}

HandShape draw_shape(const SimulatorConfig& config, float half, int hand, Random& random) {
    HandShape shape = make_hand_shape(random, draw_side(half, random));
    shape.sleeve_mm = sleeve_mm(config, hand);
    return shape;
}

}  // namespace

HandScript::HandScript(const SimulatorConfig& config, const Workplace& place, int hand)
    : place_(place),
      random_(config.seed, 0x4a4d0 + static_cast<std::uint64_t>(hand)),
      gestures_(config.gestures),
      shape_(draw_shape(config, place.half, hand, random_)),
      planner_(place_, shape_, config.human_timing, hover_band(config.gestures)),
      planned_until_s_(config.empty_s +
                       static_cast<double>(random_.uniform(0.05F, 0.4F) + 0.6F * static_cast<float>(hand))),
      guided_(config.guided),
      pause_s_(config.pause_s) {}

std::optional<HandMoment> HandScript::at(double time_s) {
    while (planned_until_s_ <= time_s) extend();
    while (!steps_.empty() && steps_.front().motion.end_s < time_s) steps_.pop_front();
    if (steps_.empty() || steps_.front().motion.start_s > time_s || steps_.front().away) return std::nullopt;
    const auto& [motion, shoulder_s, away] = steps_.front();
    const HandPosture posture = posture_at(motion, time_s, place_.scene, shape_);
    return HandMoment{build_hand(shape_, posture, shoulder_s, motion.thumb_touches), motion.thumb_touches};
}

/// A person looks for a while at what is new, touches it as well as people do, and looks again.
void HandScript::extend_as_asked() {
    constexpr double patience_s = 1.5;
    const bool again = asked_s_ == touched_s_ && planned_until_s_ < touched_until_s_ + patience_s;
    if (!asked_s_ && here_) return leave();
    if (!asked_s_ || again) return wait();
    const bool was_here = here_;
    const std::vector<Motion> motions = plan_as_asked();
    if (motions.empty() && was_here) return leave();  // from another edge it may be within reach
    if (motions.empty()) return wait();
    append(motions);
    touched_s_ = asked_s_;
    touched_until_s_ = planned_until_s_;
}

/// Whoever is not there yet comes from where the place is within reach.
std::vector<Motion> HandScript::plan_as_asked() {
    constexpr float sigma_m = 0.001F;
    constexpr int edges = 40;
    const Vec3 off(sigma_m * random_.normal(), sigma_m * random_.normal(), 0.0F);
    const double start_s = planned_until_s_ + static_cast<double>(random_.uniform(0.2F, 0.5F));
    const auto plan = [&] {
        return planner_.plan_touch(*asked_s_ + off, last_, start_s, shoulder_s_, random_);
    };
    if (here_) return plan();
    for (int edge = 0; edge < edges; ++edge) {
        start_visit();
        if (std::vector<Motion> motions = plan(); !motions.empty()) return motions;
    }
    here_ = false;
    return {};
}

void HandScript::wait() {
    constexpr double look_s = 0.1;
    const double until_s = planned_until_s_ + look_s;
    steps_.push_back({{Motion::Kind::rest, planned_until_s_, until_s, last_, last_, 0.0F, 0.0F, 0.0F, false},
                      shoulder_s_,
                      !here_});
    planned_until_s_ = until_s;
}

void HandScript::extend() {
    if (guided_) return extend_as_asked();
    if (!here_) start_visit();
    const double start_s = planned_until_s_ + static_cast<double>(random_.uniform(0.0F, 0.25F));
    std::vector<Motion> motions;
    if (gestures_left_-- > 0)
        motions = planner_.plan(draw_gesture(gestures_, random_), last_, start_s, shoulder_s_, random_);
    if (!motions.empty()) {
        append(std::move(motions));
    } else if (gestures_left_ < 0) {
        leave();
    }
}

void HandScript::start_visit() {
    const Edge edge = draw_edge(place_, random_);
    const float above_m = std::min(0.4F, 0.5F * place_.view.camera_s.z());
    shoulder_s_ = edge.at_table_s + 0.12F * edge.outward + above_m * Vec3::UnitZ();
    outside_ = HandPosture{};
    outside_.index_tip = edge.at_table_s + 0.3F * edge.outward + 0.16F * Vec3::UnitZ();
    outside_.yaw_rad = std::atan2(-edge.outward.y(), -edge.outward.x());
    outside_.thumb_tip = relaxed_thumb_tip(shape_, outside_);
    last_ = outside_;
    gestures_left_ = 5 + random_.below(12);
    here_ = true;
}

void HandScript::leave() {
    std::vector<Motion> way = planner_.glide(last_, outside_, planned_until_s_, shoulder_s_);
    if (way.empty()) way = leave_over_the_top();
    const double left_s = way.empty() ? planned_until_s_ : way.back().end_s;
    if (!way.empty()) append(std::move(way));
    const double drawn_s = random_.uniform(0.6F, 2.5F);
    const double pause_s = pause_s_ > 0.0
                               ? drawn_s - pause_s_ * std::log(1.0 - static_cast<double>(random_.uniform()))
                               : drawn_s;
    steps_.push_back(
        {{Motion::Kind::rest, left_s, left_s + pause_s, outside_, outside_, 0.0F, 0.0F, 0.0F, false},
         shoulder_s_,
         true});
    planned_until_s_ = left_s + pause_s;
    here_ = false;
}

std::vector<Motion> HandScript::leave_over_the_top() const {
    HandPosture above = last_;
    above.index_tip.z() += 0.18F;
    above.thumb_tip.z() += 0.18F;
    std::vector<Motion> way = planner_.glide(last_, above, planned_until_s_, shoulder_s_);
    if (way.empty()) return {};
    const std::vector<Motion> rest = planner_.glide(above, outside_, way.back().end_s, shoulder_s_);
    if (rest.empty()) return {};
    way.push_back(rest.front());
    return way;
}

void HandScript::append(std::vector<Motion> motions) {
    const double start_s = motions.front().start_s;
    if (start_s > planned_until_s_)
        steps_.push_back(
            {{Motion::Kind::rest, planned_until_s_, start_s, last_, last_, 0.0F, 0.0F, 0.0F, false},
             shoulder_s_,
             false});
    for (const Motion& motion : motions) steps_.push_back({motion, shoulder_s_, false});
    planned_until_s_ = motions.back().end_s;
    const Motion& end = motions.back();
    last_ = posture_at(end, end.end_s, place_.scene, shape_);
}

}  // namespace touchstone::sim
