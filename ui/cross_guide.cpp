#include "ui/cross_guide.hpp"

#include <string>

namespace touchstone {

namespace {

constexpr float arm_px = 22.f;
constexpr float words_share = 0.8f;  // of the view's width

}  // namespace

void draw_cross(Canvas& canvas, const Eigen::Vector2f& at_px) {
    const float arm = arm_px * canvas.scale(), width = style::ring_px * canvas.scale();
    const auto both_arms = [&](float width_px, style::Color color) {
        for (const Eigen::Vector2f& arm_of : {Eigen::Vector2f(arm, 0.f), Eigen::Vector2f(0.f, arm)})
            canvas.line(at_px - arm_of, at_px + arm_of, width_px, color);
    };
    both_arms(2.f * width, style::shadow.faded(0.6f));
    both_arms(width, style::white);
    canvas.ring(at_px, arm, width, style::accent);
}

void draw_cross_guide(Canvas& canvas, const ViewMapping& view, const CrossGuide& guide) {
    draw_cross(canvas, view.to_display(guide.pixel_px));
    const std::string words =
        guide.words + "  " + std::to_string(guide.touched + 1) + " of " + std::to_string(guide.wanted);
    const float wrap_px = words_share * view.rect.size_px().x(), margin = style::margin_px * canvas.scale();
    const Eigen::Vector2f size = canvas.text_size_px(TextStyle::body, words, wrap_px);
    const Eigen::Vector2f at(view.rect.center_px().x() - 0.5f * size.x(),
                             view.rect.max_px.y() - margin - size.y());
    const Eigen::Vector2f room(0.5f * margin, 0.3f * margin);
    canvas.box(at - room, at + size + room, style::corner_px * canvas.scale(), style::card);
    canvas.text(TextStyle::body, at, style::text, words, wrap_px);
}

}  // namespace touchstone
