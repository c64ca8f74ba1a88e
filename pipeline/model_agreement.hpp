#pragma once

#include <cstdint>
#include <span>

#include "pipeline/foreground_view.hpp"

namespace touchstone {

/// What the live picture says about a prediction, pixel by pixel of the prediction's surface.
struct ModelAgreement {
    int predicted = 0;  ///< pixels with a predicted surface
    int fits = 0;       ///< live depth within the tolerance of it
    int hidden = 0;     ///< something is in front of it
    int through = 0;    ///< the camera sees through it, or what is there is background

    /// Of what is not hidden; 0 where nothing is.
    float fitting_share() const;
    /// Of the predicted surface.
    float seen_share() const;
};

struct ModelAgreementConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float sigmas = 3.0f;
    float least_tolerance_m = 0.006f;
};

/// `predicted_m`: depths of the prediction, in the layout of `live`; 0 = no surface.
ModelAgreement compare_model(const ModelAgreementConfig& config, const MaskedDepth& live,
                             std::span<const float> predicted_m);

}  // namespace touchstone
