#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace touchstone {

/// The last joint of a finger: a round end and a slightly conical shaft behind it. Camera frame, metres.
struct FingerShape {
    Eigen::Vector3f center_m{0.f, 0.f, 0.f};  ///< of the round end
    Eigen::Vector3f axis{0.f, 0.f, 1.f};      ///< unit length, from the tip to the hand
    float radius_m = 0.f;                     ///< of the round end
};

/// What is known of a finger's radius before a fit.
struct RadiusPrior {
    float radius_m = 0.0078f;  ///< index fingers of adults: 6 to 9 mm, thumbs to 11
    float sigma_m = 0.0006f;
};

/// Where the round end must lie from what its outline says: on a plane through the camera.
struct OutlineConstraint {
    Eigen::Vector3f plane_normal{0.f, 0.f, 0.f};  ///< unit length; zero: nothing is known
    float sigma_m = 0.001f;
};

/// What a fit starts from and is held by.
struct FingerGuess {
    FingerShape shape;
    RadiusPrior radius;
    OutlineConstraint outline;
    float axis_sigma = 0.5f;  ///< radians by which the axis may be off
    bool rough = true;        ///< the shape is a guess, not an earlier fit
};

struct FingerFitConfig {
    float widening = 0.1f;             ///< of the radius over `length_m`
    float length_m = 0.026f;           ///< of the shaft that is used: to the first joint
    float least_radius_m = 0.005f;     ///< a child's little finger
    float greatest_radius_m = 0.012f;  ///< a thumb
    float lateral_sigma_m = 0.0007f;   ///< of a point's place across the ray: half a pixel at 1 m
    float gate_sigmas = 2.5f;          ///< points farther off the shape do not count
    float first_gate_m = 0.006f;       ///< the same in the first rounds, when the shape is a guess
    int rough_rounds = 4;              ///< with the first gate
    int rounds = 8;                    ///< at most, in all
    float settled_m = 5e-5f;           ///< a smaller step ends the fit
    int most_points = 120;             ///< of more, an even choice is used
};

struct FingerFit {
    FingerShape shape;
    int points = 0;          ///< in the reach of the shape: the round end and length_m behind it
    int inliers = 0;         ///< of them within the gate
    float rms_sigmas = 0.f;  ///< of the inliers
    /// Of centre (3), two turns of the axis and radius, priors included.
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    bool ok = false;  ///< a well-posed fit inside the limits
};

/// Distance of a point from the finger's skin, positive outside.
float distance_m(const FingerShape& shape, const FingerFitConfig& config, const Eigen::Vector3f& point_m);

/// Standard deviation of the place of the pad along a unit direction away from the finger's upper side.
float pad_sigma_m(const FingerFit& fit, const Eigen::Vector3f& normal);

/// The finger that best explains points of its visible side, by weighted Gauss-Newton from `guess`; nothing
/// where too few points are near it. `sigma_z_m` is the noise of a point along its ray.
std::optional<FingerShape> fit_shape(std::span<const Eigen::Vector3f> points_m, const FingerGuess& guess,
                                     float sigma_z_m, const FingerFitConfig& config);

/// The same, and how well it is known.
FingerFit fit_finger(std::span<const Eigen::Vector3f> points_m, const FingerGuess& guess, float sigma_z_m,
                     const FingerFitConfig& config);

}  // namespace touchstone
