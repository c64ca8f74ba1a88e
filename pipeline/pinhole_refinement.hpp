#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>

namespace touchstone {

/// A projector as it is fitted; conventions as in ProjectorModel.
struct Pinhole {
    Eigen::Vector2d focal_px{1.0, 1.0};  ///< across negative where the picture is mirrored
    Eigen::Vector2d center_px{0.0, 0.0};
    std::array<double, 4> distortion{};
    Eigen::Isometry3d T_p_g = Eigen::Isometry3d::Identity();
};

struct PinholeMatch {
    Eigen::Vector3d point_m{0.0, 0.0, 0.0};
    Eigen::Vector2d pixel_px{0.0, 0.0};
};

/// What is likely of any projector, against matches that are good to sigma_px.
struct PinholePriors {
    double width_px = 0.0, height_px = 0.0;
    double sigma_px = 0.5;
};

/// Least squares with Cauchy's weights: matches far off count little. Levenberg-Marquardt of Eigen.
Pinhole refine_pinhole(const Pinhole& start, std::span<const PinholeMatch> matches,
                       const PinholePriors& priors);

/// The sum that refine_pinhole makes small.
double pinhole_cost(const Pinhole& pinhole, std::span<const PinholeMatch> matches,
                    const PinholePriors& priors);

}  // namespace touchstone
