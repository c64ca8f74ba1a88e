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

/// Brown's lens: where an ideal place of the plane at depth 1 is seen.
template <class Scalar>
Eigen::Matrix<Scalar, 2, 1> bent(const std::array<Scalar, 4>& distortion,
                                 const Eigen::Matrix<Scalar, 2, 1>& p) {
    const auto& [k1, k2, p1, p2] = distortion;
    const Scalar r2 = p.squaredNorm(), xy = p.x() * p.y();
    const Scalar radial = 1 + r2 * (k1 + r2 * k2);
    return {radial * p.x() + 2 * p1 * xy + p2 * (r2 + 2 * p.x() * p.x()),
            radial * p.y() + p1 * (r2 + 2 * p.y() * p.y()) + 2 * p2 * xy};
}

/// How far from its axis, at depth 1, a lens maps farther out to farther out: where r (1 + k1 r^2 + k2 r^4)
/// has its first maximum. Beyond it Brown's model would bring points back into the picture. 1e30 for no end.
float lens_edge(const std::array<float, 4>& distortion);

/// None for a point behind the projector, beyond its lens's edge, or on the line of the homography that goes
/// to infinity. The pixel may lie beyond the picture.
std::optional<Eigen::Vector2f> project(const ProjectorModel& model, const Eigen::Vector3f& point_g_m);

/// The same projector where its picture is stretched to another size.
ProjectorModel stretched(const ProjectorModel& model, int width_px, int height_px);

/// The same projector for points of another frame.
ProjectorModel in_other_frame(const ProjectorModel& model, const RigidTransform& T_new_old);

}  // namespace touchstone
