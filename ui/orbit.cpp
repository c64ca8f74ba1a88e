#include "ui/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone {

namespace {

constexpr float turn_rad_per_view = std::numbers::pi_v<float>;  // for a finger that crosses the picture
constexpr float least_elevation_rad = 0.12f, most_elevation_rad = 1.55f;
constexpr float nearest = 0.25f, farthest = 3.f;  // of the first distance
constexpr float fallback_distance_m = 1.f;

}  // namespace

Orbit::Orbit(const TableFrame& frame) : intrinsics_(frame.intrinsics), T_g_c_(frame.T_g_c) {
    const Eigen::Vector3f normal_c = facing_normal(frame.area);
    up_g_ = T_g_c_.linear() * normal_c;
    // The line of sight meets the plane where n . z = n . origin.
    const float ahead = normal_c.z();
    const float distance_m =
        ahead < -0.05f ? normal_c.dot(frame.area.origin_c_m) / ahead : fallback_distance_m;
    first_distance_m_ = std::clamp(distance_m, 0.3f, 4.f);
    first_target_g_m_ = T_g_c_ * Eigen::Vector3f(0.f, 0.f, first_distance_m_);
    reset();
}

void Orbit::reset() {
    target_g_m_ = first_target_g_m_;
    distance_m_ = first_distance_m_;
    R_g_v_ = T_g_c_.linear();
}

void Orbit::turn_about(const Eigen::Vector3f& axis_g, float angle_rad) {
    R_g_v_ =
        (Eigen::AngleAxisf(angle_rad, axis_g) * Eigen::Quaternionf(R_g_v_)).normalized().toRotationMatrix();
}

void Orbit::turn(const Eigen::Vector2f& delta_px) {
    const float rad_per_px = turn_rad_per_view / static_cast<float>(intrinsics_.width_px);
    turn_about(up_g_, -rad_per_px * delta_px.x());
    const float before = elevation_rad();
    const float after = std::clamp(before + rad_per_px * delta_px.y(), std::min(before, least_elevation_rad),
                                   std::max(before, most_elevation_rad));
    // The level axis about which the line of sight tilts; seen from straight above, the view's own.
    const Eigen::Vector3f sight_g = R_g_v_.col(2), level_g = sight_g.cross(up_g_);
    const Eigen::Vector3f axis_g =
        level_g.norm() > 1e-3f ? Eigen::Vector3f(level_g.normalized()) : Eigen::Vector3f(R_g_v_.col(0));
    turn_about(axis_g, before - after);
}

void Orbit::move(const Eigen::Vector2f& delta_px) {
    const float m_per_px = distance_m_ / intrinsics_.fx_px;
    target_g_m_ -= m_per_px * (delta_px.x() * R_g_v_.col(0) + delta_px.y() * R_g_v_.col(1));
}

void Orbit::transform(const Similarity& delta) {
    // What lies under the fingers' middle stays there: it is moved to the view's middle, changed, and moved
    // back.
    const Eigen::Vector2f middle_px(intrinsics_.cx_px, intrinsics_.cy_px);
    move(middle_px - delta.center_px);
    const float scale = std::clamp(delta.scale, 0.2f, 5.f);
    distance_m_ = std::clamp(distance_m_ / scale, nearest * first_distance_m_, farthest * first_distance_m_);
    turn_about(R_g_v_.col(2), -delta.rotation_rad);
    move(delta.center_px - middle_px + delta.translation_px);
}

RigidTransform Orbit::T_g_v() const {
    RigidTransform T_g_v = RigidTransform::Identity();
    T_g_v.linear() = R_g_v_;
    T_g_v.translation() = target_g_m_ - distance_m_ * R_g_v_.col(2);
    return T_g_v;
}

float Orbit::elevation_rad() const { return std::asin(std::clamp(-R_g_v_.col(2).dot(up_g_), -1.f, 1.f)); }

}  // namespace touchstone
