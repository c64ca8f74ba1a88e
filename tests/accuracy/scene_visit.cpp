#include "tests/accuracy/scene_visit.hpp"

#include <cmath>

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int width_px = 640, height_px = 480;
constexpr float focal_px = 575.f, table_m = 1.1f;
constexpr int spheres_across = 64;

Vector2f pixel_of(const Vector3f& c) {
    return {focal_px * c.x() / c.z() + 319.5f, focal_px * c.y() / c.z() + 239.5f};
}

}  // namespace

SceneVisit::SceneVisit() : depth_mm_(width_px * height_px, 1100), last_px_(6, Vector2f(0.f, 0.f)) {
    base_.state = "live";
    base_.frame_rate_hz = 30.f;
    base_.frame_ms = 8.f;
    base_.intrinsics = {focal_px, focal_px, 319.5f, 239.5f, width_px, height_px, {0, 0}};
    base_.has_area = true;
    base_.area = {{-0.52f, -0.38f, table_m}, {1.04f, 0.f, 0.f}, {0.f, 0.76f, 0.f}};
    const InteractiveArea& area = base_.area;
    base_.area_px = {pixel_of(area.origin_c_m), pixel_of(area.origin_c_m + area.axis_u_c_m),
                     pixel_of(area.origin_c_m + area.axis_u_c_m + area.axis_v_c_m),
                     pixel_of(area.origin_c_m + area.axis_v_c_m)};
}

TableFrame SceneVisit::next(const SceneWish& wish) {
    TableFrame frame = base_;
    frame.index = ++index_;
    frame.timestamp_us = static_cast<std::uint64_t>(index_) * 33'333;
    frame.view = view();
    if (wish.particles) frame.particles = particles();
    if (wish.view) {
        auto rendered = std::make_shared<RenderedView>();
        *rendered = {wish.view->version, *frame.view, !wish.view->moving};
        frame.rendered = rendered;
    }
    touch(frame);
    return frame;
}

/// Shaded as a table is; an arm of 90 pixels wanders across it.
std::shared_ptr<const ShadedView> SceneVisit::view() const {
    auto shown = std::make_shared<ShadedView>();
    *shown = {width_px, height_px, std::vector<std::uint8_t>(std::size_t{4} * width_px * height_px)};
    const int arm = 275 + static_cast<int>(200.f * std::sin(0.02f * static_cast<float>(index_)));
    std::uint8_t* pixel = shown->rgba.data();
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x, pixel += 4) {
            const bool is_arm = y < 200 && x >= arm && x < arm + 90;
            const auto grain = static_cast<std::uint8_t>(135 + (x * 7 + y * 13) % 5 + 30 * y / height_px);
            pixel[0] = is_arm ? 214 : grain;
            pixel[1] = is_arm ? 150 : static_cast<std::uint8_t>(grain + 8);
            pixel[2] = is_arm ? 110 : static_cast<std::uint8_t>(grain + 18);
            pixel[3] = is_arm ? 0 : 255;
        }
    return shown;
}

/// A heap of 4096 that sways.
std::shared_ptr<const ParticleView> SceneVisit::particles() const {
    auto heap = std::make_shared<ParticleView>();
    heap->intrinsics = base_.intrinsics;
    heap->radius_m = 0.006f;
    heap->depth_mm = depth_mm_;
    const float sway = 0.02f * std::sin(0.1f * static_cast<float>(index_));
    for (int i = 0; i < spheres_across * spheres_across; ++i) {
        const auto column = static_cast<float>(i % spheres_across),
                   row = static_cast<float>(i / spheres_across);
        const Vector3f center(0.013f * (column - 31.5f) + sway, 0.01f * (row - 31.5f), table_m - 0.006f);
        heap->spheres.push_back({center, center + Vector3f(0.f, 0.f, 0.006f), 0.5f, i});
    }
    return heap;
}

void SceneVisit::finger(TableFrame& frame, int finger, bool down, const Vector2f& place_px) {
    const auto known = ids_.find(finger);
    if (!down && known == ids_.end()) return;
    TouchEvent event;
    event.phase = known == ids_.end() ? TouchPhase::down : down ? TouchPhase::move : TouchPhase::up;
    event.tip.id = known == ids_.end() ? ids_[finger] = ++ids_given_ : known->second;
    Vector2f& last = last_px_[static_cast<std::size_t>(finger)];
    if (event.phase != TouchPhase::up) last = place_px;
    event.tip.pixel_px = last;
    event.tip.surface_c_m = back_project(frame.intrinsics, last.x(), last.y(), table_m);
    frame.touches.push_back(event);
    if (event.phase == TouchPhase::up) ids_.erase(finger);
}

/// Two fingers draw loops, two pinch, one taps along the lower edge, one hovers.
void SceneVisit::touch(TableFrame& frame) {
    const auto t = static_cast<float>(index_) / 30.f;
    const auto beat = [&](float period_s, float share) { return std::fmod(t, period_s) < share * period_s; };
    finger(frame, 0, beat(2.3f, 0.8f), {200.f + 120.f * std::cos(2.f * t), 170.f + 70.f * std::sin(3.f * t)});
    finger(frame, 1, beat(1.7f, 0.7f),
           {440.f + 100.f * std::sin(2.7f * t), 260.f + 90.f * std::cos(1.9f * t)});
    const float half_px = 45.f + 30.f * std::sin(1.3f * t);
    const Vector2f middle(330.f + 60.f * std::sin(0.4f * t), 240.f), half(half_px, 0.4f * half_px);
    finger(frame, 2, beat(3.1f, 0.8f), middle - half);
    finger(frame, 3, beat(3.1f, 0.8f), middle + half);
    finger(frame, 4, beat(0.8f, 0.3f), {70.f + std::fmod(97.f * std::floor(t / 0.8f), 500.f), 415.f});
    HoverEvent hover;
    hover.tip.id = 1000;
    hover.tip.pixel_px = {300.f + 200.f * std::sin(t), 330.f};
    hover.tip.height_m = 0.03f;
    frame.hovers.push_back(hover);
}

}  // namespace touchstone
