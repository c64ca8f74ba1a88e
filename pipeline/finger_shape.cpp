#include "pipeline/finger_shape.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace touchstone {

namespace {

using Eigen::Vector3f;
using Vector6f = Eigen::Matrix<float, 6, 1>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

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
    // Double: the end of a shaft is held by few of the points, and float loses them in the sum.
    Matrix6d JTJ = Matrix6d::Zero();
    Vector6d JTe = Vector6d::Zero();
    int points = 0, inliers = 0;
    float square_sum = 0.0f;
    double cost = 0.0;  ///< of the shape, as Fitter::cost() gives it
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
        add_priors(shape, u, v, sum);
        sum.cost += prior_cost(shape);
        return sum;
    }

    /// Cost of a shape over the points in the reach of `anchor`, priors included: comparable between
    /// shapes.
    double cost(const FingerShape& shape, const FingerShape& anchor, bool rough) const {
        double sum = 0.0;
        for (const Vector3f& p : points_m_) {
            if ((p - anchor.center_m).dot(anchor.axis) > config_.length_m) continue;
            const Residual r = residual_of(shape, config_, p);
            sum += loss_of(r.distance_m, variance_of(r, p), rough);
        }
        return sum + prior_cost(shape);
    }

  private:
    double prior_cost(const FingerShape& shape) const {
        const double radius = (shape.radius_m - guess_.radius.radius_m) / guess_.radius.sigma_m;
        const double axis = (shape.axis - guess_.shape.axis).norm() / guess_.axis_sigma;
        const double outline = guess_.outline.plane_normal.dot(shape.center_m) / guess_.outline.sigma_m;
        return 0.5 * (radius * radius + axis * axis + outline * outline);
    }

    float variance_of(const Residual& r, const Vector3f& p) const {
        const float along_ray = sigma_z_m_ * r.outward.dot(p) / p.norm();
        return along_ray * along_ray + config_.lateral_sigma_m * config_.lateral_sigma_m;
    }
    float gate_of(float variance, bool rough) const {
        return std::max(rough ? config_.first_gate_m : 0.0f, config_.gate_sigmas * std::sqrt(variance));
    }

    /// Tukey's loss gives up on what is far off the skin.
    float weight_of(float distance_m, float variance, bool rough) const {
        const float gate_m = gate_of(variance, rough);
        const float share = std::min(1.0f, std::abs(distance_m) / gate_m);
        return (1.0f - share * share) * (1.0f - share * share) / variance;
    }
    float loss_of(float distance_m, float variance, bool rough) const {
        const float gate_m = gate_of(variance, rough);
        const float rest = 1.0f - std::min(1.0f, distance_m * distance_m / (gate_m * gate_m));
        return gate_m * gate_m / 6.0f * (1.0f - rest * rest * rest) / variance;
    }

    void add_priors(const FingerShape& shape, const Vector3f& u, const Vector3f& v,
                    NormalEquations& sum) const {
        const double radius_weight = 1.0 / (guess_.radius.sigma_m * guess_.radius.sigma_m);
        sum.JTJ(5, 5) += radius_weight;
        sum.JTe(5) += radius_weight * (shape.radius_m - guess_.radius.radius_m);
        const double axis_weight = 1.0 / (guess_.axis_sigma * guess_.axis_sigma);
        const Vector3f turned = shape.axis - guess_.shape.axis;
        sum.JTJ(3, 3) += axis_weight;
        sum.JTJ(4, 4) += axis_weight;
        sum.JTe(3) += axis_weight * turned.dot(u);
        sum.JTe(4) += axis_weight * turned.dot(v);
        const Eigen::Vector3d n = guess_.outline.plane_normal.cast<double>();
        const double outline_weight = 1.0 / (guess_.outline.sigma_m * guess_.outline.sigma_m);
        sum.JTJ.topLeftCorner<3, 3>() += outline_weight * n * n.transpose();
        sum.JTe.head<3>() += outline_weight * n.dot(shape.center_m.cast<double>()) * n;
    }

    void add_point(const FingerShape& shape, const Vector3f& u, const Vector3f& v, const Vector3f& p,
                   bool rough, NormalEquations& sum) const {
        const Residual r = residual_of(shape, config_, p);
        if (r.along_m > config_.length_m) return;
        const float variance = variance_of(r, p);
        const float weight = weight_of(r.distance_m, variance, rough);
        ++sum.points;
        sum.cost += loss_of(r.distance_m, variance, rough);
        if (std::abs(r.distance_m) <= gate_of(variance, rough)) {
            ++sum.inliers;
            sum.square_sum += r.distance_m * r.distance_m / variance;
        }
        if (weight <= 0.0f) return;
        Vector6f J;
        J << -r.outward + (r.along_m > 0.0f ? shape.radius_m * config_.widening / config_.length_m : 0.0f) *
                              shape.axis,
            -r.along_m * r.outward.dot(u), -r.along_m * r.outward.dot(v), -r.scale;
        const Vector6d weighted = (weight * J).cast<double>(), J_double = J.cast<double>();
        sum.JTJ += weighted * J_double.transpose();
        sum.JTe += static_cast<double>(r.distance_m) * weighted;
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

std::vector<Vector3f> even_choice(std::span<const Vector3f> points_m, int most) {
    const std::size_t stride = 1 + points_m.size() / static_cast<std::size_t>(most);
    std::vector<Vector3f> chosen;
    chosen.reserve(points_m.size() / stride + 1);
    for (std::size_t i = 0; i < points_m.size(); i += stride) chosen.push_back(points_m[i]);
    return chosen;
}

}  // namespace

float distance_m(const FingerShape& shape, const FingerFitConfig& config, const Vector3f& point_m) {
    return residual_of(shape, config, point_m).distance_m;
}

float pad_sigma_m(const FingerFit& fit, const Vector3f& normal) {
    Vector6d pad;
    pad << normal.cast<double>(), 0.0, 0.0, -1.0;
    return static_cast<float>(std::sqrt(pad.dot(fit.covariance * pad)));
}

FingerFit fit_finger(std::span<const Vector3f> points_m, const FingerGuess& guess, float sigma_z_m,
                     const FingerFitConfig& config) {
    const std::vector<Vector3f> chosen = even_choice(points_m, config.most_points);
    const Fitter fitter(chosen, guess, sigma_z_m, config);
    FingerFit fit;
    fit.shape = guess.shape;
    const int rough_rounds = guess.rough ? config.rough_rounds : 0;
    double damping = 1e-3;
    for (int round = 0; round < config.rounds; ++round) {
        const bool rough = round < rough_rounds;
        const NormalEquations sum = fitter.equations(fit.shape, rough);
        if (sum.inliers < 12) return fit;
        Matrix6d damped = sum.JTJ;
        damped.diagonal() *= 1.0 + damping;
        const Vector6f step = damped.ldlt().solve(-sum.JTe).cast<float>();
        if (!step.allFinite()) return fit;
        const FingerShape next = stepped(fit.shape, step, config);
        const bool better = fitter.cost(next, fit.shape, rough) < sum.cost;
        damping *= better ? 0.1 : 10.0;
        if (better) fit.shape = next;
        if (better && !rough && step.head<3>().norm() < config.settled_m) break;
    }
    const NormalEquations last = Fitter(points_m, guess, sigma_z_m, config).equations(fit.shape, false);
    fit.points = last.points;
    fit.inliers = last.inliers;
    fit.rms_sigmas = std::sqrt(last.square_sum / static_cast<float>(std::max(1, last.inliers)));
    fit.covariance = last.JTJ.ldlt().solve(Matrix6d::Identity());
    fit.ok = last.inliers >= 12;
    return fit;
}

}  // namespace touchstone
