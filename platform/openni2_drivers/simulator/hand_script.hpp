#pragma once

#include <deque>
#include <optional>

#include "platform/openni2_drivers/simulator/gesture_planner.hpp"

namespace touchstone::sim {

/// A hand at one time.
struct HandMoment {
    Hand hand;
    bool thumb_in_use = false;
};

/// The endless play of one hand: it comes in from an edge of the picture, makes gestures, leaves, and comes
/// back, from any edge that suits. All of it follows from the seed.
class HandScript {
  public:
    /// `place.half` is this hand's; the first visit starts after config.empty_s. The place must outlive the
    /// script.
    HandScript(const SimulatorConfig& config, const Workplace& place, int hand);

    /// Of a guided hand: touches this place of the surface until it is another one; none: it goes away.
    void ask(const std::optional<Vec3>& place_s) { asked_s_ = place_s; }
    /// Nothing while the hand is away. Times must not decrease from call to call.
    std::optional<HandMoment> at(double time_s);
    const HandShape& shape() const { return shape_; }

  private:
    void extend();
    void extend_as_asked();
    std::vector<Motion> plan_as_asked();
    void wait();
    void start_visit();
    void leave();
    std::vector<Motion> leave_over_the_top() const;
    void append(std::vector<Motion> motions);

    struct Step {
        Motion motion;
        Vec3 shoulder_s;
        bool away = false;
    };

    Workplace place_;
    Random random_;
    Gestures gestures_;
    HandShape shape_;
    GesturePlanner planner_;
    std::deque<Step> steps_;
    double planned_until_s_;
    HandPosture last_;
    HandPosture outside_;
    Vec3 shoulder_s_ = Vec3::Zero();
    int gestures_left_ = 0;
    bool here_ = false;
    bool guided_;
    double pause_s_;
    std::optional<Vec3> asked_s_, touched_s_;  // touched: what was asked for at the last touch
    double touched_until_s_ = 0.0;
};

}  // namespace touchstone::sim
