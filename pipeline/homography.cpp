#include "pipeline/homography.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

constexpr int draws = 400;
constexpr unsigned draw_seed = 1;

/// Takes places to zero mean and a mean distance of sqrt(2); none where all are the same.
std::optional<Matrix3d> normalising(std::span<const PlaneMatch> matches, Vector2d PlaneMatch::*place) {
    Vector2d mean = Vector2d::Zero();
    for (const PlaneMatch& match : matches) mean += match.*place;
    const auto count = static_cast<double>(matches.size());
    mean /= count;
    double distance = 0.0;
    for (const PlaneMatch& match : matches) distance += (match.*place - mean).norm() / count;
    if (distance < 1e-9) return std::nullopt;
    const double scale = std::sqrt(2.0) / distance;
    Matrix3d T = Matrix3d::Identity();
    T.diagonal() << scale, scale, 1.0;
    T.topRightCorner<2, 1>() = -scale * mean;
    return T;
}

double error_px(const Matrix3d& H, const PlaneMatch& match) {
    const Eigen::Vector3d h = H * match.place.homogeneous();
    if (h.z() <= 0.0) return INFINITY;
    return (h.hnormalized() - match.pixel_px).norm();
}

std::vector<PlaneMatch> agreeing(std::span<const PlaneMatch> matches, const Matrix3d& H,
                                 double tolerance_px) {
    std::vector<PlaneMatch> found;
    std::ranges::copy_if(matches, std::back_inserter(found),
                         [&](const PlaneMatch& match) { return error_px(H, match) <= tolerance_px; });
    return found;
}

}  // namespace

std::optional<Matrix3d> fit_homography(std::span<const PlaneMatch> matches) {
    if (matches.size() < 4) return std::nullopt;
    const auto to_place = normalising(matches, &PlaneMatch::place);
    const auto to_pixel = normalising(matches, &PlaneMatch::pixel_px);
    if (!to_place || !to_pixel) return std::nullopt;
    Eigen::Matrix<double, 9, 9> sum = Eigen::Matrix<double, 9, 9>::Zero();
    for (const PlaneMatch& match : matches) {
        const Eigen::Vector3d p = *to_place * match.place.homogeneous();
        const Vector2d q = (*to_pixel * match.pixel_px.homogeneous()).head<2>();
        Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
        rows.block<1, 3>(0, 0) = p.transpose();
        rows.block<1, 3>(0, 6) = -q.x() * p.transpose();
        rows.block<1, 3>(1, 3) = p.transpose();
        rows.block<1, 3>(1, 6) = -q.y() * p.transpose();
        sum += rows.transpose() * rows;
    }
    const Eigen::JacobiSVD<Eigen::Matrix<double, 9, 9>> svd(sum, Eigen::ComputeFullV);
    if (svd.singularValues()(7) < 1e-10 * svd.singularValues()(0)) return std::nullopt;
    const Eigen::Matrix<double, 9, 1> h = svd.matrixV().col(8);
    Matrix3d H;
    H << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
    H = to_pixel->inverse() * H * *to_place;
    Vector2d middle = Vector2d::Zero();
    for (const PlaneMatch& match : matches) middle += match.place / static_cast<double>(matches.size());
    const double sign = (H * middle.homogeneous()).z();
    if (std::abs(H.determinant()) < 1e-12 * std::pow(H.norm(), 3)) return std::nullopt;
    return Matrix3d(H / sign);
}

std::optional<Matrix3d> fit_homography_robustly(std::span<const PlaneMatch> matches, double tolerance_px) {
    if (matches.size() < 4) return std::nullopt;
    std::mt19937 random(draw_seed);
    std::vector<PlaneMatch> best;
    for (int draw = 0; draw < draws && best.size() < matches.size(); ++draw) {
        std::array<PlaneMatch, 4> four;
        std::ranges::sample(matches, four.begin(), 4, random);
        const auto H = fit_homography(four);
        if (!H) continue;
        if (auto found = agreeing(matches, *H, tolerance_px); found.size() > best.size())
            best = std::move(found);
    }
    return fit_homography(best);
}

}  // namespace touchstone
