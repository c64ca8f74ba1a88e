#include "pipeline/finger_shape.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

using Eigen::Vector3f;
using Vector6f = Eigen::Matrix<float, 6, 1>;
using Matrix6f = Eigen::Matrix<float, 6, 6>;

/// A point against the shape: place along the axis (0 over the round end), outward direction, distance.
struct Residual {
    float along_m;
    Vector3f outward;
    float scale;  ///< of the radius at this place
    float distance_m;
};

Residual residual_of(const FingerShape& shape, const FingerFitConfig& config, const Vector3f& point_m) {
    const Vector3f offset = point_m - shape.center_m;
    const float along = std::max(0.0f, offset.dot(shape.axis));
    const Vector3f across = offset - along * shape.axis;
    const float norm = std::max(1e-6f, across.norm());
    const float scale = 1.0f + config.widening * along / config.length_m;
    return {along, across / norm, scale, norm - shape.radius_m * scale};
}

/// Two directions that complete the axis to a frame.
std::pair<Vector3f, Vector3f> sideways(const Vector3f& axis) {
    const Vector3f first = axis.unitOrthogonal();
    return {first, axis.cross(first)};
}

struct NormalEquations {
    Matrix6f JTJ = Matrix6f::Zero();
    Vector6f JTe = Vector6f::Zero();
    int points = 0, inliers = 0;
    float square_sum = 0.0f;
};

class Fitter {
  public:
    Fitter(std::span<const Vector3f> points_m, const FingerGuess& guess, float sigma_z_m,
           const FingerFitConfig& config)
        : points_m_(points_m), guess_(guess), sigma_z_m_(sigma_z_m), config_(config) {}

    NormalEquations equations(const FingerShape& shape, bool rough) const {
        const auto [u, v] = sideways(shape.axis);
        NormalEquations sum;
        for (const Vector3f& p : points_m_) add_point(shape, u, v, p, rough, sum);
        const float radius_weight = 1.0f / (guess_.radius.sigma_m * guess_.radius.sigma_m);
        sum.JTJ(5, 5) += radius_weight;
        sum.JTe(5) += radius_weight * (shape.radius_m - guess_.radius.radius_m);
        const float axis_weight = 1.0f / (guess_.axis_sigma * guess_.axis_sigma);
        const Vector3f turned = shape.axis - guess_.shape.axis;
        sum.JTJ(3, 3) += axis_weight;
        sum.JTJ(4, 4) += axis_weight;
        sum.JTe(3) += axis_weight * turned.dot(u);
        sum.JTe(4) += axis_weight * turned.dot(v);
        const Vector3f n = guess_.outline.plane_normal;
        const float outline_weight = 1.0f / (guess_.outline.sigma_m * guess_.outline.sigma_m);
        sum.JTJ.topLeftCorner<3, 3>() += outline_weight * n * n.transpose();
        sum.JTe.head<3>() += outline_weight * n.dot(shape.center_m) * n;
        return sum;
    }

  private:
    void add_point(const FingerShape& shape, const Vector3f& u, const Vector3f& v, const Vector3f& p,
                   bool rough, NormalEquations& sum) const {
        const Residual r = residual_of(shape, config_, p);
        if (r.along_m > config_.length_m) return;
        const float along_ray = sigma_z_m_ * r.outward.dot(p) / p.norm();
        const float variance = along_ray * along_ray + config_.lateral_sigma_m * config_.lateral_sigma_m;
        const float gate_m =
            std::max(rough ? config_.first_gate_m : 0.0f, config_.gate_sigmas * std::sqrt(variance));
        ++sum.points;
        if (std::abs(r.distance_m) > gate_m) return;
        ++sum.inliers;
        sum.square_sum += r.distance_m * r.distance_m / variance;
        const float share = r.distance_m / gate_m;
        const float weight = (1.0f - share * share) * (1.0f - share * share) / variance;
        Vector6f J;
        J << -r.outward, -r.along_m * r.outward.dot(u), -r.along_m * r.outward.dot(v), -r.scale;
        sum.JTJ += weight * J * J.transpose();
        sum.JTe += weight * r.distance_m * J;
    }

    std::span<const Vector3f> points_m_;
    FingerGuess guess_;
    float sigma_z_m_;
    FingerFitConfig config_;
};

/// The shape after one step, kept within the limits.
FingerShape stepped(const FingerShape& shape, const Vector6f& step, const FingerFitConfig& config) {
    const auto [u, v] = sideways(shape.axis);
    const Vector6f limited = step * std::min(1.0f, 0.006f / std::max(1e-6f, step.head<3>().norm()));
    FingerShape next;
    next.center_m = shape.center_m + limited.head<3>();
    const float turn_u = std::clamp(limited[3], -0.3f, 0.3f), turn_v = std::clamp(limited[4], -0.3f, 0.3f);
    next.axis = (shape.axis + turn_u * u + turn_v * v).normalized();
    next.radius_m = std::clamp(shape.radius_m + limited[5], config.least_radius_m, config.greatest_radius_m);
    return next;
}

}  // namespace

float distance_m(const FingerShape& shape, const FingerFitConfig& config, const Vector3f& point_m) {
    return residual_of(shape, config, point_m).distance_m;
}

FingerFit fit_finger(std::span<const Vector3f> points_m, const FingerGuess& guess, float sigma_z_m,
                     const FingerFitConfig& config) {
    const Fitter fitter(points_m, guess, sigma_z_m, config);
    FingerFit fit;
    fit.shape = guess.shape;
    for (int round = 0; round < config.rounds; ++round) {
        const NormalEquations sum = fitter.equations(fit.shape, round < config.rounds / 2);
        if (sum.inliers < 12) return fit;
        const Eigen::LDLT<Matrix6f> solver(sum.JTJ);
        const Vector6f step = solver.solve(-sum.JTe);
        if (solver.info() != Eigen::Success || !step.allFinite()) return fit;
        fit.shape = stepped(fit.shape, step, config);
    }
    const NormalEquations last = fitter.equations(fit.shape, false);
    fit.points = last.points;
    fit.inliers = last.inliers;
    fit.rms_sigmas = std::sqrt(last.square_sum / static_cast<float>(std::max(1, last.inliers)));
    fit.ok = last.inliers >= 12;
    return fit;
}

}  // namespace touchstone
