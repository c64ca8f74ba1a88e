#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace touchstone {

/// A place on a plane and where it is seen.
struct PlaneMatch {
    Eigen::Vector2d place{0.0, 0.0};
    Eigen::Vector2d pixel_px{0.0, 0.0};
};

/// H with pixel ~ H [place, 1], H(2,2) of the middle place positive; least squares over normalised matches
/// (Hartley 1997). None for fewer than four, or where three of four lie on a line.
std::optional<Eigen::Matrix3d> fit_homography(std::span<const PlaneMatch> matches);

/// The same from the matches that agree to within `tolerance_px` with the best of many draws of four (RANSAC;
/// the draws are always the same).
std::optional<Eigen::Matrix3d> fit_homography_robustly(std::span<const PlaneMatch> matches,
                                                       double tolerance_px);

}  // namespace touchstone
