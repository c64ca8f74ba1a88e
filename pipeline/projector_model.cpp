#include "pipeline/projector_model.hpp"

#include <cmath>

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float least_depth_m = 0.05f;
constexpr float no_edge = 1e30f;

std::optional<Vector2f> project_plane(const ProjectorModel& model, const Vector3f& point_g_m) {
    const Vector2f uv = area_uv(model.plane_g, point_g_m);
    const Vector3f h = model.H_px_uv * Vector3f(uv.x(), uv.y(), 1.f);
    const Vector3f middle = model.H_px_uv * Vector3f(0.5f, 0.5f, 1.f);
    // Beyond the line that goes to infinity the sign differs from the plane's middle.
    if (h.z() * middle.z() <= 1e-6f * middle.z() * middle.z()) return std::nullopt;
    return Vector2f(h.x() / h.z(), h.y() / h.z());
}

}  // namespace

float lens_edge(const std::array<float, 4>& distortion) {
    const double a = 5.0 * double{distortion[1]}, b = 3.0 * double{distortion[0]};
    const double root = b * b - 4.0 * a;
    if (root < 0.0) return no_edge;
    // The smaller positive solution of a s^2 + b s + 1 = 0, s = r^2, in a form that stands a = 0.
    const double below = -b + std::sqrt(root);
    return below > 1e-9 ? static_cast<float>(std::sqrt(2.0 / below)) : no_edge;
}

std::optional<Vector2f> project(const ProjectorModel& model, const Vector3f& point_g_m) {
    if (model.kind == ProjectorModelKind::homography) return project_plane(model, point_g_m);
    const Vector3f p = model.T_p_g * point_g_m;
    if (p.z() < least_depth_m) return std::nullopt;
    const Vector2f ideal = p.head<2>() / p.z();
    if (ideal.norm() > lens_edge(model.distortion)) return std::nullopt;
    return Vector2f(model.focal_px.cwiseProduct(bent(model.distortion, ideal)) + model.center_px);
}

ProjectorModel stretched(const ProjectorModel& model, int width_px, int height_px) {
    ProjectorModel result = model;
    result.width_px = width_px;
    result.height_px = height_px;
    const Eigen::Vector2f stretch(static_cast<float>(width_px) / static_cast<float>(model.width_px),
                                  static_cast<float>(height_px) / static_cast<float>(model.height_px));
    // Pixel centres lie at whole numbers: edges are stretched, half a pixel before them.
    const Eigen::Vector2f half(0.5f, 0.5f);
    result.focal_px = stretch.cwiseProduct(model.focal_px);
    result.center_px = stretch.cwiseProduct(model.center_px + half) - half;
    Eigen::Matrix3f S = Eigen::Matrix3f::Identity();
    S.diagonal().head<2>() = stretch;
    S.topRightCorner<2, 1>() = stretch.cwiseProduct(half) - half;
    result.H_px_uv = S * model.H_px_uv;
    return result;
}

ProjectorModel in_other_frame(const ProjectorModel& model, const RigidTransform& T_new_old) {
    ProjectorModel moved = model;
    moved.T_p_g = model.T_p_g * T_new_old.inverse(Eigen::Isometry);
    moved.plane_g = transformed(T_new_old, model.plane_g);
    return moved;
}

}  // namespace touchstone
