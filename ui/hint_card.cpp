#include "ui/hint_card.hpp"

namespace touchstone {

namespace {

constexpr float words_share = 0.8f;  // of the view's width

}  // namespace

void draw_hint_card(Canvas& canvas, const ViewMapping& view, ViewEdge edge, style::Color color,
                    std::string_view words) {
    const float wrap_px = words_share * view.rect.size_px().x(), margin = style::margin_px * canvas.scale();
    const Eigen::Vector2f size = canvas.text_size_px(TextStyle::body, words, wrap_px);
    const float top =
        edge == ViewEdge::top ? view.rect.min_px.y() + margin : view.rect.max_px.y() - margin - size.y();
    const Eigen::Vector2f at(view.rect.center_px().x() - 0.5f * size.x(), top);
    const Eigen::Vector2f room(0.5f * margin, 0.3f * margin);
    canvas.box(at - room, at + size + room, style::corner_px * canvas.scale(), style::card);
    canvas.text(TextStyle::body, at, color, words, wrap_px);
}

}  // namespace touchstone
