#include "pipeline/projector_model.hpp"

#include <Eigen/LU>
#include <cmath>

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float least_depth_m = 0.05f;

/// Brown's lens: where an ideal place of the picture plane is seen.
Vector2f distorted(const std::array<float, 4>& d, const Vector2f& p) {
    const float r2 = p.squaredNorm(), xy = p.x() * p.y();
    const float radial = 1.f + r2 * (d[0] + r2 * d[1]);
    return {radial * p.x() + 2.f * d[2] * xy + d[3] * (r2 + 2.f * p.x() * p.x()),
            radial * p.y() + d[2] * (r2 + 2.f * p.y() * p.y()) + 2.f * d[3] * xy};
}

/// Its inverse, by fixed-point steps: lenses of projectors bend little.
Vector2f undistorted(const std::array<float, 4>& d, const Vector2f& seen) {
    Vector2f p = seen;
    for (int step = 0; step < 20; ++step) p += seen - distorted(d, p);
    return p;
}

std::optional<Vector2f> project_plane(const ProjectorModel& model, const Vector3f& point_g_m) {
    const Vector2f uv = area_uv(model.plane_g, point_g_m);
    const Vector3f h = model.H_px_uv * Vector3f(uv.x(), uv.y(), 1.f);
    const Vector3f middle = model.H_px_uv * Vector3f(0.5f, 0.5f, 1.f);
    // Beyond the line that goes to infinity the sign differs from the plane's middle.
    if (h.z() * middle.z() <= 1e-6f * middle.z() * middle.z()) return std::nullopt;
    return Vector2f(h.x() / h.z(), h.y() / h.z());
}

}  // namespace

std::optional<Vector2f> project(const ProjectorModel& model, const Vector3f& point_g_m) {
    if (model.kind == ProjectorModelKind::homography) return project_plane(model, point_g_m);
    const Vector3f p = model.T_p_g * point_g_m;
    if (p.z() < least_depth_m) return std::nullopt;
    return Vector2f(model.focal_px.cwiseProduct(distorted(model.distortion, p.head<2>() / p.z())) +
                    model.center_px);
}

ProjectorModel in_other_frame(const ProjectorModel& model, const RigidTransform& T_new_old) {
    ProjectorModel moved = model;
    moved.T_p_g = model.T_p_g * T_new_old.inverse(Eigen::Isometry);
    moved.plane_g = transformed(T_new_old, model.plane_g);
    return moved;
}

std::optional<Vector3f> lit_point_g_m(const ProjectorModel& model, const Vector2f& pixel_px,
                                      const InteractiveArea& area_g) {
    if (model.kind == ProjectorModelKind::homography) {
        const Vector3f uv = model.H_px_uv.inverse() * Vector3f(pixel_px.x(), pixel_px.y(), 1.f);
        if (std::abs(uv.z()) < 1e-9f) return std::nullopt;
        const InteractiveArea& plane = model.plane_g;
        return Vector3f(plane.origin_c_m + uv.x() / uv.z() * plane.axis_u_c_m +
                        uv.y() / uv.z() * plane.axis_v_c_m);
    }
    const Vector2f seen = (pixel_px - model.center_px).cwiseQuotient(model.focal_px);
    const Vector2f ideal = undistorted(model.distortion, seen);
    const RigidTransform T_g_p = model.T_p_g.inverse(Eigen::Isometry);
    const Vector3f ray_g = T_g_p.linear() * Vector3f(ideal.x(), ideal.y(), 1.f);
    const Vector3f normal_g = area_g.axis_u_c_m.cross(area_g.axis_v_c_m);
    const float towards = normal_g.dot(ray_g);
    if (std::abs(towards) < 1e-9f) return std::nullopt;
    const float depth_m = normal_g.dot(area_g.origin_c_m - T_g_p.translation()) / towards;
    if (depth_m < least_depth_m) return std::nullopt;
    return Vector3f(T_g_p.translation() + depth_m * ray_g);
}

}  // namespace touchstone
