#include "ui/operator_card.hpp"

#include <cstdio>

#include "ui/status_panel.hpp"

namespace touchstone {

namespace {

using Eigen::Vector2f;

constexpr float padding_px = 18.f, pictures_share = 0.34f, caption_room_px = 26.f;
constexpr float row_gap_px = 2.f, block_gap_px = 12.f, number_width_px = 62.f;

std::string one_decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

/// Of the two pictures, 0 the upper one: as large as the room allows, 4 to 3.
DisplayRect picture_box(const DisplayRect& card, float scale, float place) {
    const float pad = padding_px * scale, caption = caption_room_px * scale;
    const float height = 0.5f * (card.size_px().y() - 3.f * pad) - caption;
    const float width = std::min(pictures_share * card.size_px().x(), height * 4.f / 3.f);
    const Vector2f size(width, 0.75f * width);
    const Vector2f at(card.max_px.x() - pad - width,
                      card.min_px.y() + pad + caption + place * (size.y() + caption + pad));
    return {at, at + size};
}

/// Writes lines from the top down, while there is room.
class Lines {
  public:
    Lines(Canvas& canvas, const DisplayRect& room) : canvas_(canvas), room_(room), at_(room.min_px) {}

    void line(TextStyle style, style::Color color, std::string_view words) {
        const float wrap = room_.size_px().x();
        const float height = canvas_.text_size_px(style, words, wrap).y();
        if (words.empty() || at_.y() + height > room_.max_px.y()) return;
        canvas_.text(style, at_, color, words, wrap);
        at_.y() += height + row_gap_px * canvas_.scale();
    }
    /// A name, and two numbers under each other's.
    void row(std::string_view name, const std::string& first, const std::string& second, style::Color color) {
        const float height = canvas_.text_size_px(TextStyle::caption, name).y();
        if (at_.y() + height > room_.max_px.y()) return;
        canvas_.text(TextStyle::caption, at_, color, name);
        right_aligned(first, 1.f, color);
        right_aligned(second, 0.f, color);
        at_.y() += height + row_gap_px * canvas_.scale();
    }
    void space() { at_.y() += block_gap_px * canvas_.scale(); }

  private:
    void right_aligned(const std::string& text, float columns_right, style::Color color) {
        const float width = canvas_.text_size_px(TextStyle::caption, text).x();
        const float right = room_.max_px.x() - columns_right * number_width_px * canvas_.scale();
        canvas_.text(TextStyle::caption, {right - width, at_.y()}, color, text);
    }

    Canvas& canvas_;
    DisplayRect room_;
    Vector2f at_;
};

void write_state(Lines& lines, const TableFrame& frame, const OperatorView& view) {
    const StateLook look = state_look(frame.state);
    lines.line(TextStyle::heading, look.color, look.word);
    lines.line(TextStyle::caption, style::warning, frame.note);
    std::string rates = one_decimal(double{frame.frame_rate_hz}) + " frames / s";
    if (view.camera_rate_hz > 0.f) rates += ", the camera " + one_decimal(double{view.camera_rate_hz});
    lines.line(TextStyle::caption, style::text, rates);
    lines.line(TextStyle::caption, style::text_muted, view.camera);
    lines.line(TextStyle::caption, style::text_muted, view.device);
    lines.line(TextStyle::caption, style::text, view.projector);
    lines.line(TextStyle::caption, style::accent, view.recording);
    lines.space();
}

void write_faults(Lines& lines, const OperatorView& view) {
    if (view.faults.empty()) {
        lines.line(TextStyle::caption, style::text_muted, "No faults since the start");
        return;
    }
    for (const std::string& fault : view.faults) lines.line(TextStyle::caption, style::text, fault);
}

void draw_picture_frame(Canvas& canvas, const DisplayRect& box, std::string_view caption) {
    const Vector2f border = Vector2f::Constant(canvas.scale());
    canvas.box(box.min_px - border, box.max_px + border, 0.f, style::rule);
    canvas.box(box.min_px, box.max_px, 0.f, style::shadow);
    canvas.text(TextStyle::caption, box.min_px - Vector2f(0.f, caption_room_px * canvas.scale()),
                style::text_muted, caption);
}

}  // namespace

DisplayRect OperatorCardLayout::words(float scale) const {
    const Vector2f pad = Vector2f::Constant(padding_px * scale);
    return {card.min_px + pad, {depth_box(scale).min_px.x() - 1.5f * pad.x(), card.max_px.y() - pad.y()}};
}

DisplayRect OperatorCardLayout::depth_box(float scale) const { return picture_box(card, scale, 0.f); }

DisplayRect OperatorCardLayout::mask_box(float scale) const { return picture_box(card, scale, 1.f); }

void draw_operator_card(Canvas& canvas, const OperatorCardLayout& layout, const TableFrame& frame,
                        const OperatorView& view) {
    const Vector2f border = Vector2f::Constant(canvas.scale());
    const float corner = style::corner_px * canvas.scale();
    canvas.box(layout.card.min_px - border, layout.card.max_px + border, corner, style::rule);
    canvas.box(layout.card.min_px, layout.card.max_px, corner, style::card);
    draw_picture_frame(canvas, layout.depth_box(canvas.scale()), "Depth");
    draw_picture_frame(canvas, layout.mask_box(canvas.scale()), "Foreground");
    Lines lines(canvas, layout.words(canvas.scale()));
    write_state(lines, frame, view);
    write_faults(lines, view);
    lines.space();
    lines.row("ms", "median", "99 %", style::text_muted);
    for (const StageSummary& stage : view.stages)
        lines.row(stage.stage, one_decimal(stage.median_ms), one_decimal(stage.p99_ms), style::text);
}

}  // namespace touchstone
