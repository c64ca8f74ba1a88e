#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "pipeline/types.hpp"

namespace touchstone {

/// A pinhole sees every point of the scan; a homography knows one plane, and takes every point to be on it.
enum class ProjectorModelKind { pinhole, homography };

/// Which pixel of a projector lights a point of the scan. Pixel centres lie at whole numbers, origin at the
/// upper left, as in Intrinsics. Projector frame: x right, y down, z along the light.
struct ProjectorModel {
    ProjectorModelKind kind = ProjectorModelKind::pinhole;
    int width_px = 0, height_px = 0;

    // Of a pinhole.
    Eigen::Vector2f focal_px{0.f, 0.f};
    Eigen::Vector2f center_px{0.f, 0.f};          ///< far outside the middle where the lens is shifted
    std::array<float, 4> distortion{0, 0, 0, 0};  ///< k1, k2, p1, p2 (Brown 1966)
    RigidTransform T_p_g = RigidTransform::Identity();

    // Of a homography.
    InteractiveArea plane_g;  ///< in the scan's frame: where H's places are measured
    Eigen::Matrix3f H_px_uv = Eigen::Matrix3f::Identity();
};

/// None for a point behind the projector, or on the line of the homography that goes to infinity. The pixel
/// may lie beyond the picture.
std::optional<Eigen::Vector2f> project(const ProjectorModel& model, const Eigen::Vector3f& point_g_m);

/// The same projector for points of another frame.
ProjectorModel in_other_frame(const ProjectorModel& model, const RigidTransform& T_new_old);

/// Where a pixel's light hits the area (scan frame), taken as an endless plane; none where it does not.
std::optional<Eigen::Vector3f> lit_point_g_m(const ProjectorModel& model, const Eigen::Vector2f& pixel_px,
                                             const InteractiveArea& area_g);

}  // namespace touchstone
