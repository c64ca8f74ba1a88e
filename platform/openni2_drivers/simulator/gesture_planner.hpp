#pragma once

#include <optional>
#include <vector>

#include "platform/openni2_drivers/simulator/motion.hpp"

namespace touchstone::sim {

enum class Gesture { tap, hold, drag, pinch, sweep, feint };

/// Gaps of an index that never touches.
struct HoverBand {
    float least_m, most_m;
};

/// Finds movements that a hand can make without running into anything and whose contacts the camera sees.
class GesturePlanner {
  public:
    /// With a hover band, the gaps of all gestures are drawn from it, and the index is nowhere lower.
    GesturePlanner(const Workplace& place, const HandShape& shape, bool human_timing,
                   std::optional<HoverBand> hover = std::nullopt)
        : place_(place), shape_(shape), human_timing_(human_timing), hover_(hover) {}

    /// The motions of one gesture from where the hand is now, in order of time; empty when nothing was found
    /// in a few dozen tries.
    std::vector<Motion> plan(Gesture gesture, const HandPosture& now, double start_s, const Vec3& shoulder_s,
                             Random& random) const;
    /// A touch of a place of the surface that lasts for half a second or more; likewise.
    std::vector<Motion> plan_touch(const Vec3& place_s, const HandPosture& now, double start_s,
                                   const Vec3& shoulder_s, Random& random) const;
    /// The way to a posture; empty when something is in the way.
    std::vector<Motion> glide(const HandPosture& from, const HandPosture& to, double start_s,
                              const Vec3& shoulder_s) const;

  private:
    struct Target {
        HandPosture at;    ///< in contact, or at the gap
        HandPosture over;  ///< where the strike starts
        float gap_m;
    };

    std::optional<HandPosture> aim(Gesture gesture, const std::optional<Vec3>& goal_s, float gap_m,
                                   const Vec3& shoulder_s, Random& random) const;
    bool aim_thumb(HandPosture& posture, float gap_m, const Vec3& shoulder_s, Random& random) const;
    std::optional<HandPosture> move_on(Gesture gesture, const HandPosture& from, float gap_m,
                                       Random& random) const;
    bool can_rest(const HandPosture& posture, const Vec3& shoulder_s, bool thumb_touches) const;
    bool is_possible(const Motion& motion, const Vec3& shoulder_s) const;
    bool is_possible(const Motion& motion, const Vec3& shoulder_s, double step_s) const;
    std::vector<Motion> try_gesture(Gesture gesture, const std::optional<Vec3>& goal_s,
                                    const HandPosture& now, double start_s, const Vec3& shoulder_s,
                                    Random& random) const;
    std::vector<Motion> still_contact(Gesture gesture, const Target& target, double start_s,
                                      Random& random) const;
    std::vector<Motion> moving_contact(Gesture gesture, const Target& target, double start_s,
                                       Random& random) const;
    double contact_s(Random& random) const;
    float planned_gap_m(Gesture gesture, Random& random) const;
    bool is_high_enough(const Hand& hand) const;

    Workplace place_;
    HandShape shape_;
    bool human_timing_;
    std::optional<HoverBand> hover_;
};

}  // namespace touchstone::sim
