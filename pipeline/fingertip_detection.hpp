#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "pipeline/finger_shape.hpp"
#include "pipeline/height_minima.hpp"
#include "pipeline/pixel_region.hpp"
#include "pipeline/table_picture.hpp"

namespace touchstone {

struct FingertipDetectionConfig {
    HeightMinimaConfig minima;
    FingerFitConfig fit;
    float hand_area_m2 = 0.0015f;   ///< a finger belongs to something at least this large; a finger is 0.0010
    float flood_radius_m = 0.034f;  ///< a fingertip and its first joint
    float flood_step_m = 0.012f;    ///< neighbouring pixels farther apart belong to different fingers
    float least_shaft_m = 0.010f;   ///< visible length behind the round end
    float least_inliers = 0.6f;     ///< of the points in the shape's reach
    float side_gap_m = 0.005f;      ///< beside the finger's skin there is room ...
    float most_beside = 0.25f;      ///< ... but for this share of the points
    float most_rms_sigmas = 1.8f;   ///< of the inliers
    float ring_inner_m = 0.016f;    ///< background around the tip, for the sensor's local drift
    float ring_outer_m = 0.034f;
    int ring_least_pixels = 24;
    float most_drift_m = 0.012f;  ///< the sensor's drift is less; a ring that says more is on something else
    float same_tip_m = 0.010f;    ///< closer than this two tips are one
    float highest_m = 0.15f;      ///< of the pad; farther away a finger is of no interest
};

/// A finger followed before, for its radius.
struct KnownFinger {
    Eigen::Vector3f center_c_m{0.f, 0.f, 0.f};
    RadiusPrior radius;
};

/// A fingertip in one frame. Camera frame.
struct FingertipCandidate {
    FingerShape shape;
    Eigen::Vector3f surface_c_m{0.f, 0.f, 0.f};  ///< foot of the round end's centre on the background
    Eigen::Vector3f normal_c{0.f, 0.f, 0.f};     ///< of the background there
    float height_m = 0.f;                        ///< of the pad
    float rms_sigmas = 0.f;
    int points = 0;
};

/// Ends of fingers inside the boxes, found by their shape: low ends of the foreground that a finger explains.
std::vector<FingertipCandidate> detect_fingertips(const TablePicture& picture,
                                                  std::span<const PixelRegion> boxes,
                                                  std::span<const KnownFinger> known,
                                                  const FingertipDetectionConfig& config);

}  // namespace touchstone
