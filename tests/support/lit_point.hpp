#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "pipeline/projector_model.hpp"

namespace touchstone::test {

/// The ideal place that is seen here, by fixed-point steps: lenses of projectors bend little.
inline Eigen::Vector2f undistorted(const std::array<float, 4>& d, const Eigen::Vector2f& seen) {
    Eigen::Vector2f p = seen;
    for (int step = 0; step < 20; ++step) p += seen - bent(d, p);
    return p;
}

/// Where a pixel's light hits the area (scan frame), taken as an endless plane; none where it does not.
inline std::optional<Eigen::Vector3f> lit_point_g_m(const ProjectorModel& model,
                                                    const Eigen::Vector2f& pixel_px,
                                                    const InteractiveArea& area_g) {
    if (model.kind == ProjectorModelKind::homography) {
        const Eigen::Vector3f uv = model.H_px_uv.inverse() * Eigen::Vector3f(pixel_px.x(), pixel_px.y(), 1.f);
        if (std::abs(uv.z()) < 1e-9f) return std::nullopt;
        const InteractiveArea& plane = model.plane_g;
        return Eigen::Vector3f(plane.origin_c_m + uv.x() / uv.z() * plane.axis_u_c_m +
                               uv.y() / uv.z() * plane.axis_v_c_m);
    }
    const Eigen::Vector2f seen = (pixel_px - model.center_px).cwiseQuotient(model.focal_px);
    const Eigen::Vector2f ideal = undistorted(model.distortion, seen);
    const RigidTransform T_g_p = model.T_p_g.inverse(Eigen::Isometry);
    const Eigen::Vector3f ray_g = T_g_p.linear() * Eigen::Vector3f(ideal.x(), ideal.y(), 1.f);
    const Eigen::Vector3f normal_g = area_g.axis_u_c_m.cross(area_g.axis_v_c_m);
    const float towards = normal_g.dot(ray_g);
    if (std::abs(towards) < 1e-9f) return std::nullopt;
    const float depth_m = normal_g.dot(area_g.origin_c_m - T_g_p.translation()) / towards;
    constexpr float least_depth_m = 0.05f;
    if (depth_m < least_depth_m) return std::nullopt;
    return Eigen::Vector3f(T_g_p.translation() + depth_m * ray_g);
}

}  // namespace touchstone::test
