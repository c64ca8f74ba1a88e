#include "pipeline/touch_bias.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <vector>

namespace touchstone {

using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

constexpr float least_slope = 0.05f;  // sine between finger and normal: steeper ones have no direction

/// Along and across the finger on the surface; zero where it stands upright.
using Directions = Eigen::Matrix<double, 3, 2>;

Directions directions(const TouchPlace& touch) {
    Directions result = Directions::Zero();
    const Vector3f flat = touch.axis_c - touch.axis_c.dot(touch.normal_c) * touch.normal_c;
    if (flat.norm() < least_slope) return result;
    const Vector3d along = flat.normalized().cast<double>();
    result.col(0) = along;
    result.col(1) = touch.normal_c.cast<double>().cross(along);
    return result;
}

/// A touch less the mean of its cross.
struct Row {
    Vector3d place_m = Vector3d::Zero();
    Directions directions = Directions::Zero();
};

std::vector<Row> about_crosses(std::span<const CrossTouch> touches) {
    std::map<int, std::pair<Row, int>> sums;
    std::vector<Row> rows;
    for (const CrossTouch& touch : touches) {
        rows.push_back({touch.place.surface_c_m.cast<double>(), directions(touch.place)});
        auto& [sum, count] = sums[touch.cross];
        sum.place_m += rows.back().place_m;
        sum.directions += rows.back().directions;
        ++count;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto& [sum, count] = sums[touches[i].cross];
        rows[i].place_m -= sum.place_m / count;
        rows[i].directions -= sum.directions / count;
    }
    return rows;
}

float rms_m(const std::vector<Row>& rows, const Eigen::Vector2d& bias_m, double free) {
    double squares = 0.0;
    for (const Row& row : rows) squares += (row.place_m + row.directions * bias_m).squaredNorm();
    return static_cast<float>(std::sqrt(squares / std::max(free, 1.0)));
}

int crosses(std::span<const CrossTouch> touches) {
    std::map<int, int> seen;
    for (const CrossTouch& touch : touches) ++seen[touch.cross];
    return static_cast<int>(seen.size());
}

}  // namespace

Vector3f corrected(const TouchPlace& touch, const TouchBias& bias) {
    const Eigen::Vector2d bias_m(static_cast<double>(bias.along_m), static_cast<double>(bias.across_m));
    return touch.surface_c_m + (directions(touch) * bias_m).cast<float>();
}

TouchBiasFit fit_touch_bias(std::span<const CrossTouch> touches, const TouchBiasConfig& config) {
    TouchBiasFit fit;
    const int free = static_cast<int>(touches.size()) - crosses(touches);
    if (static_cast<int>(touches.size()) < config.least_touches || free < 2) return fit;
    const std::vector<Row> rows = about_crosses(touches);
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (const Row& row : rows) {
        A += row.directions.transpose() * row.directions;
        b -= row.directions.transpose() * row.place_m;
    }
    fit.rms_before_m = rms_m(rows, Eigen::Vector2d::Zero(), free);
    fit.rms_m = fit.rms_before_m;
    const double turn = 0.5 * A.trace() / static_cast<double>(touches.size());
    fit.verdict = BiasVerdict::one_sided;
    if (turn < static_cast<double>(config.least_turn)) return fit;
    const Eigen::Vector2d bias_m = A.ldlt().solve(b);
    // Two coordinates a touch lie in the surface, two unknowns a cross and two of the bias.
    fit.rms_m = rms_m(rows, bias_m, free - 1);
    fit.sigma_m = fit.rms_m / std::sqrt(static_cast<float>(A.trace()));
    fit.verdict = fit.rms_m > config.most_rms_m ? BiasVerdict::scattered : BiasVerdict::good;
    fit.bias = {static_cast<float>(bias_m.x()), static_cast<float>(bias_m.y())};
    return fit;
}

}  // namespace touchstone
