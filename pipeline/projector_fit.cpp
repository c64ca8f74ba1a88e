#include "pipeline/projector_fit.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <numeric>
#include <vector>

#include "pipeline/homography.hpp"
#include "pipeline/pinhole_refinement.hpp"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double relief_tolerance = 0.06;  // of the picture's width: what relief may move a pixel
constexpr int rough_matches = 200;
constexpr double outlier_sigmas = 4.0, least_outlier_px = 3.0;
constexpr std::array focal_shares{0.8, 1.1, 1.5, 2.0, 3.0};  // of the picture's width
constexpr std::array shift_shares{-0.1, 0.5, 1.1};           // of its height

/// The plane that points lie closest to, with places on it in metres.
struct FittedPlane {
    Vector3d middle = Vector3d::Zero();
    Matrix3d axes = Matrix3d::Identity();  // columns: along, along, normal
    double relief_m = 0.0;

    Vector2d place(const Vector3d& point) const { return (axes.transpose() * (point - middle)).head<2>(); }
};

FittedPlane fit_plane(std::span<const PinholeMatch> matches) {
    FittedPlane plane;
    const auto count = static_cast<double>(matches.size());
    for (const PinholeMatch& match : matches) plane.middle += match.point_m / count;
    Matrix3d spread = Matrix3d::Zero();
    for (const PinholeMatch& match : matches) {
        const Vector3d offset = match.point_m - plane.middle;
        spread += offset * offset.transpose() / count;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread);
    plane.axes << solver.eigenvectors().col(2), solver.eigenvectors().col(1), solver.eigenvectors().col(0);
    if (plane.axes.determinant() < 0.0) plane.axes.col(2) *= -1.0;
    plane.relief_m = std::sqrt(std::max(0.0, solver.eigenvalues()(0)));
    return plane;
}

/// Zhang 2000: the pose of a plane before a camera of known K.
Pinhole take_apart(const Matrix3d& H, const Vector2d& focal_px, const Vector2d& center_px,
                   const FittedPlane& plane) {
    Matrix3d K = Matrix3d::Identity();
    K.diagonal() << focal_px.x(), focal_px.y(), 1.0;
    K.topRightCorner<2, 1>() = center_px;
    const Matrix3d columns = K.inverse() * H;
    const double scale = 2.0 / (columns.col(0).norm() + columns.col(1).norm());
    Matrix3d rough;
    rough << scale * columns.col(0), scale * columns.col(1),
        (scale * columns.col(0)).cross(scale * columns.col(1));
    const Eigen::JacobiSVD<Matrix3d> svd(rough, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
    if (turn.determinant() < 0.0)
        turn = svd.matrixU() * Vector3d(1, 1, -1).asDiagonal() * svd.matrixV().transpose();
    Pinhole pinhole;
    pinhole.focal_px = focal_px;
    pinhole.center_px = center_px;
    pinhole.T_p_g.linear() = turn * plane.axes.transpose();
    pinhole.T_p_g.translation() = scale * columns.col(2) - pinhole.T_p_g.linear() * plane.middle;
    return pinhole;
}

std::vector<PinholeMatch> thinned(std::span<const PinholeMatch> matches, std::size_t most) {
    std::vector<PinholeMatch> some;
    const std::size_t step = std::max<std::size_t>(1, matches.size() / most);
    for (std::size_t i = 0; i < matches.size(); i += step) some.push_back(matches[i]);
    return some;
}

/// The best of likely projectors after a few steps on some matches.
Pinhole find_pinhole(std::span<const PinholeMatch> matches, const Matrix3d& H, const FittedPlane& plane,
                     const PinholePriors& priors) {
    const std::vector<PinholeMatch> some = thinned(matches, rough_matches);
    const Vector2d size(priors.width_px, priors.height_px);
    Pinhole best;
    double least = INFINITY;
    for (const double mirrored : {1.0, -1.0}) {
        for (const double focal : focal_shares) {
            for (const double shift : shift_shares) {
                const Vector2d focal_px(mirrored * focal * size.x(), focal * size.x());
                const Vector2d center_px(0.5 * size.x(), shift * size.y());
                const Pinhole found = refine_pinhole(take_apart(H, focal_px, center_px, plane), some, priors);
                const double cost = pinhole_cost(found, some, priors);
                if (cost < least) {
                    least = cost;
                    best = found;
                }
            }
        }
    }
    return best;
}

std::vector<double> errors_px(const ProjectorModel& model, std::span<const ProjectorMatch> matches) {
    std::vector<double> errors;
    for (const ProjectorMatch& match : matches) {
        const auto at = project(model, match.point_g_m);
        errors.push_back(at ? static_cast<double>((*at - match.pixel_px).norm()) : INFINITY);
    }
    return errors;
}

/// How good the matches are, each way, whatever lies far off.
double sigma_px(const ProjectorModel& model, std::span<const ProjectorMatch> matches) {
    std::vector<double> errors = errors_px(model, matches);
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    return *middle / 1.18;  // of a normal distribution in two dimensions
}

std::vector<ProjectorMatch> without_outliers(const ProjectorModel& model,
                                             std::span<const ProjectorMatch> matches) {
    const std::vector<double> errors = errors_px(model, matches);
    const double limit = std::max(least_outlier_px, outlier_sigmas * sigma_px(model, matches));
    std::vector<ProjectorMatch> kept;
    for (std::size_t i = 0; i < matches.size(); ++i)
        if (errors[i] <= limit) kept.push_back(matches[i]);
    return kept;
}

std::vector<PinholeMatch> in_double(std::span<const ProjectorMatch> matches) {
    std::vector<PinholeMatch> result;
    for (const ProjectorMatch& match : matches)
        result.push_back({match.point_g_m.cast<double>(), match.pixel_px.cast<double>()});
    return result;
}

ProjectorModel to_model(const Pinhole& pinhole, const PinholePriors& priors) {
    ProjectorModel model;
    model.kind = ProjectorModelKind::pinhole;
    model.width_px = static_cast<int>(priors.width_px);
    model.height_px = static_cast<int>(priors.height_px);
    model.focal_px = pinhole.focal_px.cast<float>();
    model.center_px = pinhole.center_px.cast<float>();
    std::ranges::transform(pinhole.distortion, model.distortion.begin(),
                           [](double value) { return static_cast<float>(value); });
    model.T_p_g = pinhole.T_p_g.cast<float>();
    return model;
}

std::vector<PlaneMatch> on_plane(std::span<const ProjectorMatch> matches, const auto& place) {
    std::vector<PlaneMatch> result;
    for (const ProjectorMatch& match : matches)
        result.push_back({place(match.point_g_m), match.pixel_px.cast<double>()});
    return result;
}

std::optional<ProjectorModel> fit_plane_model(std::span<const ProjectorMatch> matches, int width_px,
                                              int height_px, const InteractiveArea& area_g) {
    const auto uv = [&](const Eigen::Vector3f& point) {
        return Vector2d(area_uv(area_g, point).cast<double>());
    };
    const std::vector<PlaneMatch> places = on_plane(matches, uv);
    const auto rough = fit_homography_robustly(places, 0.01 * width_px);
    if (!rough) return std::nullopt;
    ProjectorModel model;
    model.kind = ProjectorModelKind::homography;
    model.width_px = width_px;
    model.height_px = height_px;
    model.plane_g = area_g;
    model.H_px_uv = rough->cast<float>();
    const auto refined = fit_homography(on_plane(without_outliers(model, matches), uv));
    if (refined) model.H_px_uv = refined->cast<float>();
    return model;
}

std::optional<ProjectorModel> fit_pinhole_model(std::span<const ProjectorMatch> matches,
                                                const FittedPlane& plane, const PinholePriors& priors) {
    const auto place = [&](const Eigen::Vector3f& point) { return plane.place(point.cast<double>()); };
    const auto H = fit_homography_robustly(on_plane(matches, place), relief_tolerance * priors.width_px);
    if (!H) return std::nullopt;
    Pinhole pinhole = find_pinhole(in_double(matches), *H, plane, priors);
    ProjectorModel model = to_model(pinhole, priors);
    for (int round = 0; round < 3; ++round) {
        PinholePriors seen = priors;
        seen.sigma_px = std::max(priors.sigma_px, sigma_px(model, matches));
        pinhole = refine_pinhole(pinhole, in_double(without_outliers(model, matches)), seen);
        model = to_model(pinhole, priors);
    }
    return model;
}

/// They tell little of the rest of the picture where they lie close together.
bool are_crowded(std::span<const ProjectorMatch> matches, int width_px, int height_px, float least_spread) {
    Eigen::AlignedBox2f box;
    for (const ProjectorMatch& match : matches) box.extend(match.pixel_px);
    return box.sizes().x() < least_spread * static_cast<float>(width_px) ||
           box.sizes().y() < least_spread * static_cast<float>(height_px);
}

void judge(ProjectorFit& fit, std::span<const ProjectorMatch> matches, const InteractiveArea& area_g,
           const ProjectorFitConfig& config) {
    const std::vector<ProjectorMatch> used = without_outliers(fit.model, matches);
    fit.used = static_cast<int>(used.size());
    double sum_px2 = 0.0, sum_m2 = 0.0;
    for (const double error : errors_px(fit.model, used)) sum_px2 += error * error;
    for (const ProjectorMatch& match : used) {
        const double error = light_off_m(fit.model, match, area_g);
        sum_m2 += error * error;
    }
    const double count = std::max<double>(1.0, static_cast<double>(used.size()));
    fit.rms_px = static_cast<float>(std::sqrt(sum_px2 / count));
    fit.rms_mm = static_cast<float>(1000.0 * std::sqrt(sum_m2 / count));
    const bool many_are_off = 2 * fit.used < fit.matches;
    fit.verdict = many_are_off || fit.rms_px > config.most_rms_px ? ProjectorVerdict::scattered
                                                                  : ProjectorVerdict::good;
}

}  // namespace

ProjectorFit fit_projector(std::span<const ProjectorMatch> matches, int width_px, int height_px,
                           const InteractiveArea& area_g, const ProjectorFitConfig& config) {
    ProjectorFit fit;
    fit.matches = static_cast<int>(matches.size());
    if (fit.matches < std::max(4, config.least_matches)) return fit;
    if (are_crowded(matches, width_px, height_px, config.least_spread)) {
        fit.verdict = ProjectorVerdict::crowded;
        return fit;
    }
    const FittedPlane plane = fit_plane(in_double(matches));
    fit.relief_m = static_cast<float>(plane.relief_m);
    const PinholePriors priors{static_cast<double>(width_px), static_cast<double>(height_px),
                               static_cast<double>(config.sigma_px)};
    const bool is_flat = fit.relief_m < config.least_relief_m || fit.matches < 6;
    const auto model = is_flat ? fit_plane_model(matches, width_px, height_px, area_g)
                               : fit_pinhole_model(matches, plane, priors);
    if (!model) {
        fit.verdict = ProjectorVerdict::scattered;
        return fit;
    }
    fit.model = *model;
    judge(fit, matches, area_g, config);
    return fit;
}

/// The step along the area that would move the pixel so far.
double light_off_m(const ProjectorModel& model, const ProjectorMatch& match, const InteractiveArea& area_g) {
    constexpr float step_m = 0.001f;
    const auto at = project(model, match.point_g_m);
    const auto along_u = project(model, match.point_g_m + step_m * area_g.axis_u_c_m.normalized());
    const auto along_v = project(model, match.point_g_m + step_m * area_g.axis_v_c_m.normalized());
    if (!at || !along_u || !along_v) return 0.0;
    Eigen::Matrix2d px_per_m;
    px_per_m << (*along_u - *at).cast<double>(), (*along_v - *at).cast<double>();
    px_per_m /= static_cast<double>(step_m);
    return (px_per_m.inverse() * (match.pixel_px - *at).cast<double>()).norm();
}

std::string describe(const ProjectorFit& fit) {
    switch (fit.verdict) {
        case ProjectorVerdict::good:
            return fmt::format("{}: {} of {} points lie within {:.2f} pixels rms, {:.1f} mm",
                               fit.model.kind == ProjectorModelKind::pinhole
                                   ? "a pinhole projector"
                                   : "one plane only, a homography of it",
                               fit.used, fit.matches, fit.rms_px, fit.rms_mm);
        case ProjectorVerdict::too_few:
            return fmt::format(
                "{} points are too few: let the projector's picture cover more of what the camera sees",
                fit.matches);
        case ProjectorVerdict::crowded:
            return "the points lie close together: let the projector's picture cover more of what the camera "
                   "sees";
        case ProjectorVerdict::scattered:
            break;
    }
    return fmt::format(
        "{} of {} points agree, to {:.1f} pixels: has the camera, the projector or a thing on the "
        "table moved?",
        fit.used, fit.matches, fit.rms_px);
}

}  // namespace touchstone
