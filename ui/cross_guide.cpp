#include "ui/cross_guide.hpp"

#include <string>

#include "ui/hint_card.hpp"

namespace touchstone {

namespace {

constexpr float arm_px = 22.f;

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
    draw_hint_card(canvas, view, ViewEdge::bottom, style::text, words);
}

}  // namespace touchstone
