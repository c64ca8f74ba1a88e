#include "ui/table_things.hpp"

#include <algorithm>
#include <utility>

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float ball_m = 0.12f, model_m = 0.17f;  // at first
constexpr float least_m = 0.05f, most_m = 0.40f;
constexpr float finger_mm = 12.f;
constexpr float lamp_m = 0.9f;          // over the table
constexpr float finger_rise_m = 0.25f;  // a surface higher over the table's plane is none to stand on

}  // namespace

TableThings::TableThings(const TableFrame& frame)
    : origin_g_m_(frame.T_g_c * frame.area.origin_c_m),
      u_g_m_(frame.T_g_c.linear() * frame.area.axis_u_c_m),
      v_g_m_(frame.T_g_c.linear() * frame.area.axis_v_c_m),
      up_g_(frame.T_g_c.linear() * facing_normal(frame.area)),
      light_g_m_(lamp_g_m(frame.area, frame.T_g_c)) {
    reset();
}

void TableThings::reset() {
    things_[ball] = {origin_g_m_ + 0.36f * u_g_m_ + 0.5f * v_g_m_, ball_m};
    things_[model] = {origin_g_m_ + 0.64f * u_g_m_ + 0.5f * v_g_m_, model_m};
    fingers_.clear();
    is_changed_ = true;
}

Vector3f TableThings::middle_g_m(int thing) const { return foot_g_m(thing) + 0.5f * size_m(thing) * up_g_; }

RigidTransform TableThings::T_g_m() const {
    RigidTransform T_g_m = RigidTransform::Identity();
    const Vector3f x = u_g_m_.normalized();
    Eigen::Matrix3f axes;
    axes << x, up_g_, x.cross(up_g_);
    T_g_m.linear() = axes * Eigen::AngleAxisf(things_[model].yaw_rad, Vector3f::UnitY());
    T_g_m.translation() = things_[model].foot_g_m;
    return T_g_m;
}

RigidTransform TableThings::T_g_l() const {
    const Vector3f z = (middle_g_m(model) - light_g_m_).normalized();
    const Vector3f across = std::abs(z.dot(u_g_m_.normalized())) < 0.9f ? u_g_m_ : v_g_m_;
    const Vector3f y = z.cross(across).normalized();
    RigidTransform T_g_l = RigidTransform::Identity();
    T_g_l.linear() << y.cross(z), y, z;
    T_g_l.translation() = light_g_m_;
    return T_g_l;
}

std::optional<int> TableThings::hit(const SurfaceGeometry& surface, const Vector2f& place_px) const {
    std::optional<int> nearest;
    float nearest_px = 0.f;
    for (const int thing : {ball, model}) {
        const auto middle_px = surface.pixel_px(middle_g_m(thing));
        if (!middle_px) continue;
        const float radius_px = surface.length_px(middle_g_m(thing), 500.f * size_m(thing) + finger_mm);
        const float beyond_px = (*middle_px - place_px).norm() - radius_px;
        if (beyond_px > 0.f || (nearest && beyond_px >= nearest_px)) continue;
        nearest = thing;
        nearest_px = beyond_px;
    }
    return nearest;
}

void TableThings::on_touch(const TouchEvent& event, const SurfaceGeometry& surface) {
    const Fingertip& tip = event.tip;
    const Vector3f at_g_m = surface.point_g_m(tip);
    if (event.phase == TouchPhase::down) {
        if (const auto thing = hit(surface, tip.pixel_px))
            fingers_.insert_or_assign(tip.id, Finger{*thing, at_g_m, at_g_m});
        return;
    }
    const auto finger = fingers_.find(tip.id);
    if (finger == fingers_.end()) return;
    finger->second.at_g_m = at_g_m;
    if (event.phase == TouchPhase::up) fingers_.erase(finger);
}

void TableThings::on_gesture(const Gesture& gesture) {
    const auto* transform = std::get_if<Transform>(&gesture.what);
    if (transform == nullptr || transform->phase == GesturePhase::end || !gesture.target) return;
    Thing& thing = things_[static_cast<std::size_t>(*gesture.target)];
    thing.size_m = std::clamp(thing.size_m * transform->delta.scale, least_m, most_m);
    // Clockwise as seen from above is a negative turn about the axis that points there.
    thing.yaw_rad -= transform->delta.rotation_rad;
    is_changed_ = true;
}

void TableThings::drag(int thing) {
    Vector3f moved_m(0.f, 0.f, 0.f);
    float height = 0.f;
    int fingers = 0;
    for (auto& [id, finger] : fingers_) {
        if (finger.thing != thing) continue;
        moved_m += finger.at_g_m - finger.told_g_m;
        finger.told_g_m = finger.at_g_m;
        height += std::clamp(height_m(finger.at_g_m), -finger_rise_m, finger_rise_m);
        ++fingers;
    }
    if (fingers == 0 || moved_m.isZero(1e-5f)) return;
    moved_m /= static_cast<float>(fingers);
    height /= static_cast<float>(fingers);
    Vector3f& foot = things_[static_cast<std::size_t>(thing)].foot_g_m;
    const Vector3f at = foot + moved_m - origin_g_m_;
    const float u = std::clamp(at.dot(u_g_m_) / u_g_m_.squaredNorm(), 0.f, 1.f);
    const float v = std::clamp(at.dot(v_g_m_) / v_g_m_.squaredNorm(), 0.f, 1.f);
    foot = origin_g_m_ + u * u_g_m_ + v * v_g_m_ + height * up_g_;
    is_changed_ = true;
}

bool TableThings::update() {
    drag(ball);
    drag(model);
    return std::exchange(is_changed_, false);
}

}  // namespace touchstone
