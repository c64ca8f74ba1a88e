#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

struct InteractiveAreaConfig {
    float plane_tolerance_m = 0.012f;  ///< of the dominant plane
    float standing_height_m = 0.30f;   ///< things up to this height above the plane belong to the area
    float cell_m = 0.02f;              ///< grid in which the largest filled rectangle is sought
    float margin_m = 0.02f;            ///< taken off each side: border cells are filled in part
    float min_side_m = 0.10f;          ///< a smaller rectangle is none
};

/// A plane n . p = d of the camera frame, n facing the camera.
struct Plane {
    Eigen::Vector3f normal_c{0.f, 0.f, -1.f};
    float offset_m = 0.0f;
    float share = 0.0f;  ///< of the points given that lie on it
};

/// The plane with the most points (RANSAC with a fixed seed, then least squares); nothing under 15 % of them.
std::optional<Plane> dominant_plane(const std::vector<Eigen::Vector3f>& points_c_m, float tolerance_m);

/// The largest rectangle of the dominant plane that the scanned surface fills, sides along the picture's: u
/// to the right, v downwards. Nothing where there is no plane or no such rectangle.
std::optional<InteractiveArea> fit_interactive_area(const SurfacePrediction& background,
                                                    const Intrinsics& intrinsics,
                                                    const InteractiveAreaConfig& config);

/// Where there is no plane: a rectangle that faces the camera and fills the view at the middle of what was
/// scanned.
InteractiveArea whole_view_area(const SurfacePrediction& background, const Intrinsics& intrinsics);

/// The inverse of area_uv(), camera frame.
Eigen::Vector3f point_on(const InteractiveArea& area, const Eigen::Vector2f& uv);

/// Around an area, from its origin along u.
inline const std::array<Eigen::Vector2f, 4> area_corners_uv{{{0.f, 0.f}, {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}}};

/// Corners in the depth picture, around the area.
std::array<Eigen::Vector2f, 4> area_corners_px(const InteractiveArea& area, const Intrinsics& intrinsics);

}  // namespace touchstone
