#pragma once

#include <Eigen/Core>
#include <span>

namespace touchstone {

/// Moves, turns and scales about `center_px`: p' = center + translation + scale * R(rotation) * (p - center).
/// Pixels of the depth picture, y down, so that a positive rotation is clockwise as seen.
struct Similarity {
    Eigen::Vector2f center_px{0.f, 0.f};
    Eigen::Vector2f translation_px{0.f, 0.f};
    float scale = 1.f;
    float rotation_rad = 0.f;  ///< -pi..pi

    Eigen::Vector2f operator()(const Eigen::Vector2f& point_px) const;
};

/// The similarity about the centroid of `from_px` that takes it nearest to `to_px`, least squares over all
/// pairs. The residual is the symmetric one of Horn (1987), whose scale is the ratio of the two spreads: from
/// frame to frame, noise then cancels and does not shrink what three fingers hold. One pair, or places that
/// all coincide, give the translation alone; no pair gives the identity.
Similarity fit_similarity(std::span<const Eigen::Vector2f> from_px, std::span<const Eigen::Vector2f> to_px);

}  // namespace touchstone
