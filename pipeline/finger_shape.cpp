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

constexpr int least_inliers = 12;

/// Four points, one a lane.
using Lanes = Eigen::Array4f;

struct LaneVector {
    Lanes x, y, z;
};

Lanes dot(const LaneVector& a, const Vector3f& b) { return a.x * b.x() + a.y * b.y() + a.z * b.z(); }
Lanes dot(const LaneVector& a, const LaneVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Four of the points that are fitted to. `counts` is 0 in the lanes behind the last one, else 1.
struct FourPoints {
    LaneVector at_m;
    Lanes inverse_distance;  ///< 1 / distance from the camera
    Lanes counts;
};

/// Points against the shape: place along the axis (0 over the round end), outward direction, distance.
struct Residuals {
    Lanes along_m;
    LaneVector outward;
    Lanes scale;  ///< of the radius at this place
    Lanes distance_m;
};

Residuals residuals_of(const FingerShape& shape, const FingerFitConfig& config, const LaneVector& p) {
    const Vector3f& c = shape.center_m;
    const LaneVector offset{p.x - c.x(), p.y - c.y(), p.z - c.z()};
    Residuals r;
    r.along_m = dot(offset, shape.axis).max(0.0f);
    const LaneVector across{offset.x - r.along_m * shape.axis.x(), offset.y - r.along_m * shape.axis.y(),
                            offset.z - r.along_m * shape.axis.z()};
    const Lanes norm = dot(across, across).sqrt().max(1e-6f), inverse = norm.inverse();
    r.outward = {across.x * inverse, across.y * inverse, across.z * inverse};
    r.scale = 1.0f + (config.widening / config.length_m) * r.along_m;
    r.distance_m = norm - shape.radius_m * r.scale;
    return r;
}

/// An even choice of at most `most` points.
std::vector<FourPoints> in_lanes(std::span<const Vector3f> points_m, std::size_t most) {
    const std::size_t stride = 1 + points_m.size() / most;
    std::vector<FourPoints> fours;
    fours.reserve(points_m.size() / stride / 4 + 1);
    for (std::size_t i = 0; i < points_m.size(); i += 4 * stride) {
        FourPoints four;
        for (std::size_t lane = 0; lane < 4; ++lane) {
            const std::size_t from = i + lane * stride;
            const Vector3f p = points_m[from < points_m.size() ? from : i];
            const auto to = static_cast<Eigen::Index>(lane);
            four.at_m.x[to] = p.x(), four.at_m.y[to] = p.y(), four.at_m.z[to] = p.z();
            four.inverse_distance[to] = 1.0f / p.norm();
            four.counts[to] = from < points_m.size() ? 1.0f : 0.0f;
        }
        fours.push_back(four);
    }
    return fours;
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
    Fitter(std::span<const Vector3f> points_m, std::size_t most_points, const FingerGuess& guess,
           float sigma_z_m, const FingerFitConfig& config)
        : points_(in_lanes(points_m, most_points)), guess_(guess), sigma_z_m_(sigma_z_m), config_(config) {}

    NormalEquations equations(const FingerShape& shape, bool rough) const {
        const auto [u, v] = sideways(shape.axis);
        NormalEquations sum;
        for (const FourPoints& points : points_) add_points(shape, u, v, points, rough, sum);
        add_priors(shape, u, v, sum);
        sum.cost += prior_cost(shape);
        return sum;
    }

    /// Cost of a shape over the points in the reach of `anchor`, priors included: comparable between
    /// shapes.
    double cost(const FingerShape& shape, const FingerShape& anchor, bool rough) const {
        const float reach_m = anchor.center_m.dot(anchor.axis) + config_.length_m;
        double sum = 0.0;
        for (const FourPoints& points : points_) {
            const Residuals r = residuals_of(shape, config_, points.at_m);
            const Lanes variance = variance_of(r, points), gate_m = gate_of(variance, rough);
            const Lanes used =
                (dot(points.at_m, anchor.axis) <= reach_m).select(points.counts, Lanes::Zero());
            sum += static_cast<double>((used * loss_of(r.distance_m, variance, gate_m)).sum());
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

    Lanes variance_of(const Residuals& r, const FourPoints& points) const {
        const Lanes along_ray = sigma_z_m_ * dot(r.outward, points.at_m) * points.inverse_distance;
        return along_ray * along_ray + config_.lateral_sigma_m * config_.lateral_sigma_m;
    }
    Lanes gate_of(const Lanes& variance, bool rough) const {
        return (config_.gate_sigmas * variance.sqrt()).max(rough ? config_.first_gate_m : 0.0f);
    }

    /// Tukey's loss gives up on what is far off the skin.
    static Lanes weight_of(const Lanes& distance_m, const Lanes& variance, const Lanes& gate_m) {
        const Lanes share = (distance_m / gate_m).abs().min(1.0f), rest = 1.0f - share * share;
        return rest * rest / variance;
    }
    static Lanes loss_of(const Lanes& distance_m, const Lanes& variance, const Lanes& gate_m) {
        const Lanes share = (distance_m / gate_m).abs().min(1.0f), rest = 1.0f - share * share;
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

    void add_points(const FingerShape& shape, const Vector3f& u, const Vector3f& v, const FourPoints& points,
                    bool rough, NormalEquations& sum) const {
        const Residuals r = residuals_of(shape, config_, points.at_m);
        const Lanes used = (r.along_m <= config_.length_m).select(points.counts, Lanes::Zero());
        if (used.maxCoeff() <= 0.0f) return;
        const Lanes variance = variance_of(r, points), gate_m = gate_of(variance, rough);
        const Lanes inliers = (r.distance_m.abs() <= gate_m).select(used, Lanes::Zero());
        sum.points += static_cast<int>(used.sum());
        sum.inliers += static_cast<int>(inliers.sum());
        sum.square_sum += (inliers * r.distance_m * r.distance_m / variance).sum();
        sum.cost += static_cast<double>((used * loss_of(r.distance_m, variance, gate_m)).sum());
        const Lanes weight = used * weight_of(r.distance_m, variance, gate_m);
        const float widening = shape.radius_m * config_.widening / config_.length_m;
        const Lanes widens = (r.along_m > 0.0f).select(Lanes::Constant(widening), Lanes::Zero());
        Eigen::Matrix<double, 6, 4> J, weighted;
        const auto set_row = [&](Eigen::Index row, const Lanes& values) {
            J.row(row) = values.matrix().transpose().cast<double>();
            weighted.row(row) = (weight * values).matrix().transpose().cast<double>();
        };
        set_row(0, widens * shape.axis.x() - r.outward.x);
        set_row(1, widens * shape.axis.y() - r.outward.y);
        set_row(2, widens * shape.axis.z() - r.outward.z);
        set_row(3, -r.along_m * dot(r.outward, u));
        set_row(4, -r.along_m * dot(r.outward, v));
        set_row(5, -r.scale);
        sum.JTJ.noalias() += weighted * J.transpose();
        sum.JTe.noalias() += weighted * r.distance_m.matrix().cast<double>();
    }

    std::vector<FourPoints> points_;
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
    const Vector3f offset = point_m - shape.center_m;
    const float along = std::max(0.0f, offset.dot(shape.axis));
    return (offset - along * shape.axis).norm() -
           shape.radius_m * (1.0f + config.widening * along / config.length_m);
}

float pad_sigma_m(const FingerFit& fit, const Vector3f& normal) {
    Vector6d pad;
    pad << normal.cast<double>(), 0.0, 0.0, -1.0;
    return static_cast<float>(std::sqrt(pad.dot(fit.covariance * pad)));
}

std::optional<FingerShape> fit_shape(std::span<const Vector3f> points_m, const FingerGuess& guess,
                                     float sigma_z_m, const FingerFitConfig& config) {
    const Fitter fitter(points_m, static_cast<std::size_t>(config.most_points), guess, sigma_z_m, config);
    FingerShape shape = guess.shape;
    const int rough_rounds = guess.rough ? config.rough_rounds : 0;
    double damping = 1e-3;
    for (int round = 0; round < config.rounds; ++round) {
        const bool rough = round < rough_rounds;
        const NormalEquations sum = fitter.equations(shape, rough);
        if (sum.inliers < least_inliers) return std::nullopt;
        Matrix6d damped = sum.JTJ;
        damped.diagonal() *= 1.0 + damping;
        const Vector6f step = damped.ldlt().solve(-sum.JTe).cast<float>();
        if (!step.allFinite()) return std::nullopt;
        const FingerShape next = stepped(shape, step, config);
        const bool better = fitter.cost(next, shape, rough) < sum.cost;
        damping *= better ? 0.1 : 10.0;
        if (better) shape = next;
        if (better && !rough && step.head<3>().norm() < config.settled_m) break;
    }
    return shape;
}

FingerFit fit_finger(std::span<const Vector3f> points_m, const FingerGuess& guess, float sigma_z_m,
                     const FingerFitConfig& config) {
    FingerFit fit;
    const std::optional<FingerShape> shape = fit_shape(points_m, guess, sigma_z_m, config);
    if (!shape) return fit;
    fit.shape = *shape;
    const Fitter all(points_m, points_m.size() + 1, guess, sigma_z_m, config);
    const NormalEquations last = all.equations(fit.shape, false);
    fit.points = last.points;
    fit.inliers = last.inliers;
    fit.rms_sigmas = std::sqrt(last.square_sum / static_cast<float>(std::max(1, last.inliers)));
    fit.covariance = last.JTJ.ldlt().solve(Matrix6d::Identity());
    fit.ok = last.inliers >= least_inliers;
    return fit;
}

}  // namespace touchstone
