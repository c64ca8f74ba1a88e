#include "platform/openni2_drivers/simulator/motion.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone::sim {
namespace {

/// A strike is the first 80 % of a minimum-jerk reach: it ends at about 40 % of its top speed.
float strike_share(float s) {
    constexpr float cut = 0.8F;
    return minimum_jerk(cut * s) / minimum_jerk(cut);
}

HandPosture between(const HandPosture& from, const HandPosture& to, float share) {
    const auto mix = [share](float a, float b) { return a + share * (b - a); };
    HandPosture now;
    now.index_tip = from.index_tip + share * (to.index_tip - from.index_tip);
    now.thumb_tip = from.thumb_tip + share * (to.thumb_tip - from.thumb_tip);
    now.yaw_rad = mix(from.yaw_rad, to.yaw_rad);
    now.pitch_rad = mix(from.pitch_rad, to.pitch_rad);
    now.bend_rad = mix(from.bend_rad, to.bend_rad);
    now.curl = mix(from.curl, to.curl);
    return now;
}

HandPosture traced(const Motion& motion, float share, const Scene& scene, const HandShape& shape) {
    HandPosture now = between(motion.from, motion.to, share);
    const Vec3 way = motion.to.index_tip - motion.from.index_tip;
    const float length = way.head<2>().norm();
    if (length > 0.0F) {
        const Vec3 aside =
            Vec3(-way.y(), way.x(), 0.0F) * (4.0F * share * (1.0F - share) * motion.bow_m / length);
        now.index_tip += aside;
        now.thumb_tip += aside;
    }
    const float straight_z = now.index_tip.z();
    now.index_tip.z() =
        scene.resting_height_m(now.index_tip.x(), now.index_tip.y(), shape.fingertip_radius_m + motion.gap_m);
    if (motion.thumb_touches)
        now.thumb_tip.z() = scene.resting_height_m(now.thumb_tip.x(), now.thumb_tip.y(),
                                                   thumb_radius_m(shape) + motion.gap_m);
    else
        now.thumb_tip.z() += now.index_tip.z() - straight_z;
    return now;
}

}  // namespace

HandPosture posture_at(const Motion& motion, double time_s, const Scene& scene, const HandShape& shape) {
    const double length_s = std::max(1e-6, motion.end_s - motion.start_s);
    const auto s = static_cast<float>(std::clamp((time_s - motion.start_s) / length_s, 0.0, 1.0));
    switch (motion.kind) {
        case Motion::Kind::rest:
            return motion.from;
        case Motion::Kind::strike:
            return between(motion.from, motion.to, strike_share(s));
        case Motion::Kind::lift:
            return between(motion.from, motion.to, 1.0F - strike_share(1.0F - s));
        case Motion::Kind::trace:
            return traced(motion, minimum_jerk(s), scene, shape);
        case Motion::Kind::glide:
            break;
    }
    HandPosture now = between(motion.from, motion.to, minimum_jerk(s));
    const float rise = 16.0F * motion.arch_m * s * s * (1.0F - s) * (1.0F - s);
    now.index_tip.z() += rise;
    now.thumb_tip.z() += rise;
    return now;
}

}  // namespace touchstone::sim
