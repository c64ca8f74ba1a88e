#pragma once

#include <Eigen/Core>
#include <span>

namespace touchstone {

/// What is added to the measured place of every touch, along the surface.
struct TouchBias {
    float along_m = 0.f;   ///< from the tip to the hand
    float across_m = 0.f;  ///< to the left of that, seen from above the surface
};

/// A touch as it was measured. Camera frame.
struct TouchPlace {
    Eigen::Vector3f surface_c_m{0.f, 0.f, 0.f};
    Eigen::Vector3f normal_c{0.f, 0.f, -1.f};  ///< of the surface there
    Eigen::Vector3f axis_c{0.f, 1.f, 0.f};     ///< of the finger, unit length, from the tip to the hand
};

/// The place without the bias; as it is where the finger stands upright on the surface.
Eigen::Vector3f corrected(const TouchPlace& touch, const TouchBias& bias);

/// One touch of a cross, one of several from different sides.
struct CrossTouch {
    int cross = 0;
    TouchPlace place;
};

enum class BiasVerdict {
    good,
    too_few,    ///< touches
    one_sided,  ///< the fingers came from one side: their bias cannot be told from the crosses' places
    scattered,  ///< touches of one cross lie too far apart
};

struct TouchBiasConfig {
    int least_touches = 6;
    float least_turn = 0.25f;  ///< mean square of what turns in the fingers' directions, 0 one side to 1 all
    float most_rms_m = 0.006f;
};

struct TouchBiasFit {
    TouchBias bias;
    BiasVerdict verdict = BiasVerdict::too_few;
    float rms_before_m = 0.f;  ///< of touches about the place of their cross, without the bias ...
    float rms_m = 0.f;         ///< ... and with it
    float sigma_m = 0.f;       ///< of along_m and across_m
};

/// Least squares over bias and the crosses' places, which need not be known: they lie where they are touched.
TouchBiasFit fit_touch_bias(std::span<const CrossTouch> touches, const TouchBiasConfig& config);

}  // namespace touchstone
