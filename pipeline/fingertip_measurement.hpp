#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "pipeline/finger_shape.hpp"
#include "pipeline/local_drift.hpp"
#include "pipeline/low_end.hpp"
#include "pipeline/table_picture.hpp"

namespace touchstone {

struct FingertipMeasurementConfig {
    FingerFitConfig fit;
    RadiusPrior radius;             ///< of a finger not followed before
    float outline_sigma_px = 0.5f;  ///< of the end of a finger's outline, averaged over its width
    float outline_loss_px =
        0.5f;  ///< by which outlines are short: the last pixels are too low to be foreground
    float least_shaft_m = 0.010f;  ///< visible length behind the round end
    float least_inliers = 0.6f;    ///< of the points in the shape's reach
    float side_gap_m = 0.005f;     ///< beside the finger's skin there is room ...
    float most_beside = 0.25f;     ///< ... but for this share of the points
    float most_beyond = 0.08f;     ///< points farther out than the round end
    int least_shaft_points = 6;    ///< points on the visible length
    float most_rms_sigmas = 1.8f;  ///< of the inliers
    float radius_bias_px = -0.1f;  ///< fitted radii are this much short: the sensor's window blurs edges
    LocalDriftConfig drift;
    float most_below_m =
        0.010f;  ///< a pad farther below the surface is a wrong fit: four sigmas of its height
    float most_height_sigma_m =
        0.005f;                ///< a pad less well known is not seen: the shape slid along the shaft
    float sure_score = 0.75f;  ///< inliers less unexplained, of the points: a followed finger fits so well
    float known_reach_m = 0.025f;  ///< a followed finger this close is the same one
};

/// A finger followed before: where it is expected, and how well its radius and direction are known.
struct KnownFinger {
    FingerShape shape;
    RadiusPrior radius;
    float axis_sigma = 0.25f;  ///< radians
};

/// A fingertip in one frame. Camera frame.
struct FingertipCandidate {
    FingerShape shape;
    Eigen::Vector3f surface_c_m{0.f, 0.f, 0.f};  ///< foot of the round end's centre on the background
    Eigen::Vector3f normal_c{0.f, 0.f, 0.f};     ///< of the background there
    float height_m = 0.f;                        ///< of the pad
    float height_sigma_m = 0.001f;               ///< its noise, as the fit knows it
    float rms_sigmas = 0.f;
    int points = 0;
};

/// The finger that ends at a low end of the foreground; nothing where the points are not those of a finger.
std::optional<FingertipCandidate> measure_fingertip(const TablePicture& picture, const LowEnd& end,
                                                    std::span<const KnownFinger> known,
                                                    const FingertipMeasurementConfig& config);

}  // namespace touchstone
