#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "pipeline/types.hpp"

namespace touchstone {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The sums of Listing 1 over all pairs: minimise sum w (r - J x)^2 over the twist x = (omega, t), which
/// moves points p to c + exp(omega) (p - c) + t. Metres and radians.
struct AlignmentSums {
    Matrix6d A = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    double weight = 0.0;            ///< sum of w
    double weighted_squares = 0.0;  ///< sum of w r^2, m^2
    double squares = 0.0;           ///< sum of r^2 over the pairs that count, m^2
    double pairs = 0.0;             ///< that count
    double close = 0.0;             ///< pairs within 2 sigma_z
    double compared = 0.0;          ///< live pixels with a model behind or before them
    double measured = 0.0;          ///< live pixels
    /// b of strips of rows that are so high that their noise is independent; their sum is b.
    std::vector<Vector6d> b_of_strips;
};

/// How well a step is known: its covariance is A^-1 scatter A^-1. Neighbouring pixels share their noise, so
/// the number of pixels does not tell; the strips of a picture, which are independent, do.
struct StepEvidence {
    Matrix6d A = Matrix6d::Zero();
    Matrix6d scatter = Matrix6d::Zero();         ///< covariance of b
    Eigen::Vector3f centre_m{0.0f, 0.0f, 0.0f};  ///< about which the twist turns
};

/// From the sums at, or next to, the solution.
StepEvidence step_evidence(const AlignmentSums& sums, const Eigen::Vector3f& centre_m);

/// Eq 1 solved, without the directions that the data do not constrain.
struct TwistSolution {
    Vector6d twist = Vector6d::Zero();
    Vector6d eigenvalues = Vector6d::Zero();  ///< of A normalised, ascending; 1 for a perfect constraint
    int held = 0;                             ///< how many directions were left as they are
};

/// A is divided by the sum of weights, and rotations are counted as the movement of a point at the distance
/// `lever_m` from the centre, so that all eigenvalues have one unit. Directions whose eigenvalue is below
/// `min_eigenvalue` are held (a flat wall must not slide). Cholesky where nothing is held.
TwistSolution solve_twist(const AlignmentSums& sums, double lever_m, double min_eigenvalue);

/// p -> c + exp(omega) (p - c) + t.
RigidTransform twist_about(const Vector6d& twist, const Eigen::Vector3f& centre);
/// The inverse of twist_about().
Vector6d twist_of(const RigidTransform& T, const Eigen::Vector3f& centre);

/// The rotation part made orthonormal again after many products.
RigidTransform orthonormal(const RigidTransform& T);

}  // namespace touchstone
