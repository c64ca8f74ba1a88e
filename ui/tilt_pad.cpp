#include "ui/tilt_pad.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone {

namespace {

using Eigen::Vector2f;

constexpr float radius_mm = 52.f;
constexpr float knob_share = 0.36f, travel_share = 0.62f;  // of the radius
constexpr float spring_s = 0.12f, at_rest = 0.002f;

}  // namespace

bool TiltPad::on_touch(const TouchEvent& event) {
    const Vector2f from_center = event.tip.pixel_px - center_px_;
    if (event.phase == TouchPhase::down && from_center.norm() <= radius_px_) {
        if (finger_) return true;  // one is enough
        finger_ = event.tip.id;
    }
    if (finger_ != event.tip.id) return false;
    const Vector2f moved = from_center / std::max(travel_share * radius_px_, 1.f);
    offset_ = moved / std::max(1.f, moved.norm());
    if (event.phase == TouchPhase::up) finger_.reset();
    return true;
}

void TiltPad::update(float dt_s) {
    if (finger_) return;
    offset_ *= std::exp(-std::max(dt_s, 0.f) / spring_s);
    if (offset_.norm() < at_rest) offset_.setZero();
}

void TiltPad::lay_out(const SurfaceGeometry& surface) {
    radius_px_ = radius_mm / surface.mm_per_px(surface.bottom_row(1.f).max());
    const Eigen::AlignedBox2f row = surface.bottom_row(2.f * radius_px_);
    center_px_ = {row.max().x() - radius_px_, row.center().y()};
}

void TiltPad::draw(Canvas& canvas, const ViewMapping& view) const {
    const float s = canvas.scale(), radius = radius_px_ * view.display_px_per_px;
    const Vector2f center = view.to_display(center_px_);
    canvas.disc(center, radius + s, style::rule);
    canvas.disc(center, radius, style::card);
    canvas.ring(center, travel_share * radius, 1.5f * s, style::white.faded(0.22f));
    for (const Vector2f& way :
         std::array<Vector2f, 4>{Vector2f(1.f, 0.f), {-1.f, 0.f}, {0.f, 1.f}, {0.f, -1.f}}) {
        const Vector2f across(-way.y(), way.x()), tip = center + 0.88f * radius * way;
        const Vector2f back = tip - 0.1f * radius * way;
        canvas.line(tip, back + 0.1f * radius * across, 2.f * s, style::text_muted);
        canvas.line(tip, back - 0.1f * radius * across, 2.f * s, style::text_muted);
    }
    const Vector2f knob = center + travel_share * radius * offset_;
    canvas.disc(knob, knob_share * radius, finger_ ? style::accent : style::text);
    canvas.ring(knob, 0.55f * knob_share * radius, 1.5f * s, style::card.faded(0.5f));
}

}  // namespace touchstone
