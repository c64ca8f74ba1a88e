#include "ui/finger_marks.hpp"

#include <algorithm>

namespace touchstone {

namespace {

constexpr float farthest_hover_m = 0.06f;
constexpr float ring_growth = 1.1f;  // of the radius, at farthest_hover_m

void draw_hover(Canvas& canvas, const Eigen::Vector2f& at_px, const Fingertip& tip) {
    const float scale = canvas.scale();
    const float far = std::clamp(tip.height_m / farthest_hover_m, 0.f, 1.f);
    const float radius_px = style::hover_radius_px * scale * (1.f + ring_growth * far);
    const float ring_px = style::ring_px * scale;
    canvas.ring(at_px, radius_px, 2.f * ring_px, style::shadow.faded(0.35f));
    canvas.ring(at_px, radius_px, ring_px, style::finger_color(tip.id).faded(1.f - 0.4f * far));
    canvas.disc(at_px, 0.6f * ring_px, style::white.faded(0.9f));
}

void draw_touch(Canvas& canvas, const Eigen::Vector2f& at_px, const Fingertip& tip) {
    const float scale = canvas.scale();
    const float radius_px = style::touch_radius_px * scale;
    const float ring_px = style::ring_px * scale;
    canvas.disc(at_px, radius_px + 2.5f * ring_px, style::finger_color(tip.id).faded(0.28f));
    canvas.disc(at_px, radius_px + ring_px, style::white);
    canvas.disc(at_px, radius_px, style::finger_color(tip.id));
}

}  // namespace

void FingerMarks::on_touch(const TouchEvent& event) {
    if (event.phase == TouchPhase::up)
        touching_.erase(event.tip.id);
    else
        touching_.insert_or_assign(event.tip.id, event.tip);
}

void FingerMarks::on_hovers(std::span<const HoverEvent> hovers) {
    hovering_.assign(hovers.begin(), hovers.end());
}

void FingerMarks::clear() {
    touching_.clear();
    hovering_.clear();
}

std::vector<int> FingerMarks::touching_ids() const {
    std::vector<int> ids;
    for (const auto& [id, tip] : touching_) ids.push_back(id);
    return ids;
}

void FingerMarks::draw(Canvas& canvas, const ViewMapping& view) const {
    for (const HoverEvent& hover : hovering_)
        draw_hover(canvas, view.to_display(hover.tip.pixel_px), hover.tip);
    for (const auto& [id, tip] : touching_) draw_touch(canvas, view.to_display(tip.pixel_px), tip);
}

}  // namespace touchstone
