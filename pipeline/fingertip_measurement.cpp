#include "pipeline/fingertip_measurement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

FingerGuess guess_from_points(const LowEnd& end, const RadiusPrior& prior) {
    Vector3f centroid = Vector3f::Zero();
    for (const Vector3f& p : end.points_m) centroid += p;
    centroid /= static_cast<float>(end.points_m.size());
    const Vector3f along = centroid - end.seed_m;
    FingerGuess guess;
    guess.radius = prior;
    guess.shape.radius_m = prior.radius_m;
    guess.shape.axis = along.norm() > 1e-4f ? Vector3f(along.normalized()) : Vector3f(0.0f, 0.0f, -1.0f);
    guess.shape.center_m =
        end.seed_m + prior.radius_m * (0.6f * guess.shape.axis + 0.4f * end.seed_m.normalized());
    return guess;
}

const KnownFinger* known_near(const Vector3f& point_m, std::span<const KnownFinger> known, float reach_m) {
    const KnownFinger* nearest = nullptr;
    for (const KnownFinger& finger : known) {
        const float distance = (finger.shape.center_m - point_m).norm();
        if (distance >= reach_m) continue;
        reach_m = distance;
        nearest = &finger;
    }
    return nearest;
}

/// Where the outline of the end puts the middle of the round end. The area of a strip along the axis is its
/// length times its width: rough edges average out.
OutlineConstraint outline_of(const Intrinsics& k, const LowEnd& end, const FingerShape& shape,
                             const FingertipMeasurementConfig& config) {
    constexpr float half_width = 0.6f;    // of the strip, in radii
    constexpr float mean_reach = 0.935f;  // of a circle's edge over that width, in radii
    const Vector2f center = project(k, shape.center_m);
    const Vector2f toward_hand = project(k, shape.center_m + 0.01f * shape.axis) - center;
    const float pixel_m = shape.center_m.z() / k.fx_px, radius_px = shape.radius_m / pixel_m;
    OutlineConstraint outline;
    if (toward_hand.norm() * pixel_m < 0.0015f) return outline;  // seen from the end: nothing to go by
    const Vector2f along = toward_hand.normalized(), across(-along.y(), along.x());
    int count = 0;
    for (const Vector2f& pixel : end.pixels_px) {
        const Vector2f offset = pixel - center;
        count += std::abs(offset.dot(across)) <= half_width * radius_px && offset.dot(along) <= radius_px;
    }
    const float length_px =
        static_cast<float>(count) / (2.0f * half_width * radius_px) + config.outline_loss_px;
    const float shift_px = (1.0f + mean_reach) * radius_px - length_px;
    if (std::abs(shift_px) > radius_px) return outline;
    const Vector2f middle = center + shift_px * along;
    const auto ray = [&](const Vector2f& pixel) {
        return Vector3f((pixel.x() - k.cx_px) / k.fx_px, (pixel.y() - k.cy_px) / k.fy_px, 1.0f);
    };
    outline.plane_normal = ray(middle).cross(ray(middle + across)).normalized();
    outline.sigma_m = config.outline_sigma_px * pixel_m;
    return outline;
}

/// Whether the points of the fit hold the pad's height, too.
bool is_pad_held(const TablePicture& picture, const FingerFit& fit, float most_sigma_m) {
    const SurfacePoint foot = foot_point(picture, fit.shape.center_m);
    return foot.known && pad_sigma_m(fit, foot.normal_c) <= most_sigma_m;
}

FingerFit fit_with_outline(const TablePicture& picture, const LowEnd& end, FingerGuess guess,
                           const FingertipMeasurementConfig& config) {
    const float sigma_m = sigma_z_m(picture.noise, end.seed_m.z());
    guess.outline = outline_of(picture.intrinsics, end, guess.shape, config);
    guess.outline.sigma_m *= 3.0f;  // of a guess
    const std::optional<FingerShape> rough = fit_shape(end.points_m, guess, sigma_m, config.fit);
    if (!rough) return {};
    guess.shape = *rough;
    guess.rough = false;
    guess.outline = outline_of(picture.intrinsics, end, *rough, config);
    FingerFit fit = fit_finger(end.points_m, guess, sigma_m, config.fit);
    fit.ok = fit.ok && is_pad_held(picture, fit, config.most_height_sigma_m);
    return fit;
}

/// How the points around a low end fare under a fit.
struct Census {
    int near = 0;    ///< round the end and beside the shaft
    int beyond = 0;  ///< of them: farther out than the round end explains
    int beside = 0;  ///< of them: outside the shaft
    int shaft = 0;   ///< of them: on the shaft behind the round end
    int inliers = 0;

    /// Fits of the same points are compared by this.
    int score() const { return inliers - 2 * beside - 4 * beyond; }
};

Census census_of(const LowEnd& end, const FingerFit& fit, const FingertipMeasurementConfig& config) {
    Census census;
    census.inliers = fit.inliers;
    for (const Vector3f& p : end.points_m) {
        const float along = (p - fit.shape.center_m).dot(fit.shape.axis);
        if (along > config.fit.length_m) continue;
        ++census.near;
        const bool outside = distance_m(fit.shape, config.fit, p) > config.side_gap_m;
        census.beyond += outside && along < 0.0f;
        census.beside += outside && along >= 0.0f;
        census.shaft += !outside && along > config.least_shaft_m;
    }
    return census;
}

/// Whether the points around the end are those of a finger: a shaft behind the tip, and room on both sides.
bool looks_like_finger(const Census& census, const FingerFit& fit, const FingertipMeasurementConfig& config) {
    const auto share = [&](int part) {
        return static_cast<float>(part) / static_cast<float>(std::max(1, census.near));
    };
    return fit.ok && share(census.beside) <= config.most_beside &&
           share(census.beyond) <= config.most_beyond && census.shaft >= config.least_shaft_points &&
           share(fit.inliers) >= config.least_inliers && fit.rms_sigmas <= config.most_rms_sigmas;
}

}  // namespace

std::optional<FingertipCandidate> measure_fingertip(const TablePicture& picture, const LowEnd& end,
                                                    std::span<const KnownFinger> known,
                                                    const FingertipMeasurementConfig& config) {
    if (end.points_m.empty()) return std::nullopt;
    const KnownFinger* before = known_near(end.seed_m, known, config.known_reach_m);
    FingerFit fit;
    Census census;
    if (before != nullptr) {
        const FingerGuess guess{before->shape, before->radius, {}, before->axis_sigma, true};
        fit = fit_with_outline(picture, end, guess, config);
        census = census_of(end, fit, config);
    }
    // Where it was not followed, or is not where it was expected.
    if (!fit.ok || static_cast<float>(census.score()) < config.sure_score * static_cast<float>(census.near)) {
        const RadiusPrior prior = before != nullptr ? before->radius : config.radius;
        const FingerFit fresh = fit_with_outline(picture, end, guess_from_points(end, prior), config);
        const Census counted = census_of(end, fresh, config);
        if (fresh.ok && (!fit.ok || counted.score() > census.score())) {
            fit = fresh;
            census = counted;
        }
    }
    if (!looks_like_finger(census, fit, config)) return std::nullopt;
    const SurfacePoint foot = foot_point(picture, fit.shape.center_m);
    if (!foot.known) return std::nullopt;
    const float center_height_m = (fit.shape.center_m - foot.point_c_m).norm();
    const float bias_m = config.radius_bias_px * end.seed_m.z() / picture.intrinsics.fx_px;
    FingertipCandidate tip;
    tip.shape = fit.shape;
    tip.normal_c = foot.normal_c;
    tip.surface_c_m = foot.point_c_m;
    tip.height_m =
        center_height_m - fit.shape.radius_m - 2.0f * bias_m - local_drift_m(picture, foot, config.drift);
    tip.height_sigma_m = pad_sigma_m(fit, foot.normal_c);
    if (tip.height_m < -config.most_below_m) return std::nullopt;
    tip.rms_sigmas = fit.rms_sigmas;
    tip.points = fit.inliers;
    return tip;
}

}  // namespace touchstone
