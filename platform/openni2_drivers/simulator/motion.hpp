#pragma once

#include "platform/openni2_drivers/simulator/workplace.hpp"

namespace touchstone::sim {

/// One piece of a hand's movement, in continuous time: frames sample it wherever they fall.
struct Motion {
    enum class Kind {
        glide,   ///< through the air, with an arch
        strike,  ///< down onto the surface: arrives with speed, as taps do
        lift,    ///< the strike run backwards
        rest,
        trace,  ///< along the surface at a constant gap
    };
    Kind kind = Kind::rest;
    double start_s = 0.0;
    double end_s = 0.0;
    HandPosture from, to;
    float arch_m = 0.0F;         ///< glide: rise in the middle
    float gap_m = 0.0F;          ///< trace: of the fingertips
    float bow_m = 0.0F;          ///< trace: sideways, in the middle
    bool thumb_touches = false;  ///< the thumb is in use
};

/// The posture at a time inside the motion.
HandPosture posture_at(const Motion& motion, double time_s, const Scene& scene, const HandShape& shape);

/// The thumb's rounded end.
inline float thumb_radius_m(const HandShape& shape) { return 1.2F * shape.fingertip_radius_m; }

}  // namespace touchstone::sim
