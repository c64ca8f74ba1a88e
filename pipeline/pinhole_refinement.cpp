#include "pipeline/pinhole_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>
#include <vector>

#include "pipeline/projector_model.hpp"

namespace touchstone {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index unknowns = 14;
constexpr int prior_rows = 8;
constexpr double behind_px = 1e4;  // what a point behind the projector is off
constexpr double cauchy_sigmas = 3.0;
// How far projectors are from ideal ones: a guess that leaves room for all, and keeps a flat scene from
// bending what it does not tell.
constexpr double square_sigma = 0.01, focal_sigma = 0.7, focal_share = 1.6;
constexpr double across_sigma = 0.05, down_sigma = 0.6;  // of the centre, by the picture's width and height
constexpr double k1_sigma = 0.1, k2_sigma = 0.05, tangential_sigma = 0.005;

Vector2d project(const Pinhole& p, const Vector3d& point_m) {
    const Vector3d at = p.T_p_g * point_m;
    if (at.z() < 0.01) return Vector2d::Constant(behind_px);
    const Vector2d xy = at.head<2>() / at.z();
    return p.focal_px.cwiseProduct(bent(p.distortion, xy)) + p.center_px;
}

/// Steps from a start: focal length and its ratio as logarithms, the turn as an angle-axis vector on its
/// left.
Pinhole moved(const Pinhole& start, const VectorXd& x) {
    Pinhole p = start;
    p.focal_px.x() *= std::exp(x(0));
    p.focal_px.y() *= std::exp(x(0) + x(1));
    p.center_px += 1000.0 * x.segment<2>(2);
    for (Index i = 0; i < 4; ++i) p.distortion[static_cast<std::size_t>(i)] += x(4 + i);
    const Vector3d turn = x.segment<3>(8);
    if (turn.norm() > 0.0)
        p.T_p_g.linear() =
            (Eigen::AngleAxisd(turn.norm(), turn.normalized()) * Eigen::Quaterniond(p.T_p_g.linear()))
                .toRotationMatrix();
    p.T_p_g.translation() += x.segment<3>(11);
    return p;
}

/// In sigmas of the priors.
Eigen::Matrix<double, prior_rows, 1> unlikeliness(const Pinhole& p, const PinholePriors& priors) {
    Eigen::Matrix<double, prior_rows, 1> rows;
    rows << std::log(p.focal_px.y() / std::abs(p.focal_px.x())) / square_sigma,
        std::log(p.focal_px.y() / (focal_share * priors.width_px)) / focal_sigma,
        (p.center_px.x() / priors.width_px - 0.5) / across_sigma,
        (p.center_px.y() / priors.height_px - 0.5) / down_sigma, p.distortion[0] / k1_sigma,
        p.distortion[1] / k2_sigma, p.distortion[2] / tangential_sigma, p.distortion[3] / tangential_sigma;
    return rows;
}

/// Cauchy's loss: its root, so that squares add up to it.
double damped(double sigmas) {
    return cauchy_sigmas * std::sqrt(std::log1p(sigmas * sigmas / (cauchy_sigmas * cauchy_sigmas)));
}

struct Residuals {
    using Scalar = double;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
    using InputType = VectorXd;
    using ValueType = VectorXd;
    using JacobianType = Eigen::MatrixXd;

    const Pinhole& start;
    std::span<const PinholeMatch> matches;
    const PinholePriors& priors;

    int inputs() const { return static_cast<int>(unknowns); }
    int values() const { return 2 * static_cast<int>(matches.size()) + prior_rows; }
    int operator()(const VectorXd& x, VectorXd& rows) const {
        const Pinhole p = moved(start, x);
        Index row = 0;
        for (const PinholeMatch& match : matches) {
            const Vector2d off = (project(p, match.point_m) - match.pixel_px) / priors.sigma_px;
            const double length = off.norm();
            const double share = length > 1e-9 ? damped(length) / length : 1.0;
            rows.segment<2>(row) = share * off;
            row += 2;
        }
        rows.tail<prior_rows>() = unlikeliness(p, priors);
        return 0;
    }
};

}  // namespace

Pinhole refine_pinhole(const Pinhole& start, std::span<const PinholeMatch> matches,
                       const PinholePriors& priors) {
    constexpr Index most_evaluations = 60;
    const Residuals residuals{start, matches, priors};
    Eigen::NumericalDiff<Residuals> differentiated(residuals);
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals>> solver(differentiated);
    solver.parameters.maxfev = most_evaluations * unknowns;
    solver.parameters.xtol = solver.parameters.ftol = 1e-7;
    VectorXd x = VectorXd::Zero(unknowns);
    solver.minimize(x);
    return moved(start, x);
}

double pinhole_cost(const Pinhole& pinhole, std::span<const PinholeMatch> matches,
                    const PinholePriors& priors) {
    const Residuals residuals{pinhole, matches, priors};
    VectorXd rows(residuals.values());
    residuals(VectorXd::Zero(unknowns), rows);
    return rows.squaredNorm();
}

}  // namespace touchstone
