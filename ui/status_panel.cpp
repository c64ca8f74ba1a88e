#include "ui/status_panel.hpp"

namespace touchstone {

namespace {

constexpr const char* product_name = "Touchstone";
constexpr float indent_px = 36.f;  // of words behind the mark or the state's dot
constexpr float baseline = 0.78f;  // of a line's height, from its top
constexpr float note_room_px = 14.f;

/// The product's mark: a touch on a surface, seen from above.
void draw_mark(Canvas& canvas, const Eigen::Vector2f& center, float radius) {
    canvas.ring(center, radius, 0.2f * radius, style::accent.faded(0.45f));
    canvas.disc(center, 0.45f * radius, style::accent);
}

void draw_state_dot(Canvas& canvas, const Eigen::Vector2f& center, style::Color color) {
    canvas.disc(center, 10.f * canvas.scale(), color.faded(0.22f));
    canvas.disc(center, 5.5f * canvas.scale(), color);
}

/// Lays words out from the top of the room down.
class Column {
  public:
    Column(Canvas& canvas, const DisplayRect& room) : canvas_(canvas), room_(room), at_(room.min_px) {}

    float scale() const { return canvas_.scale(); }
    Eigen::Vector2f at() const { return at_; }
    void space(float px) { at_.y() += px * scale(); }

    void text(TextStyle style, float from_left_px, style::Color color, std::string_view words) {
        const Eigen::Vector2f at = at_ + Eigen::Vector2f(from_left_px * scale(), 0.f);
        const float wrap = room_.max_px.x() - at.x();
        canvas_.text(style, at, color, words, wrap);
        at_.y() += canvas_.text_size_px(style, words, wrap).y();
    }

    void figure(const Figure& figure) {
        const Eigen::Vector2f value = canvas_.text_size_px(TextStyle::figure, figure.value);
        const float unit_height = canvas_.text_size_px(TextStyle::body, figure.unit).y();
        canvas_.text(TextStyle::figure, at_, style::text, figure.value);
        canvas_.text(TextStyle::body,
                     at_ + Eigen::Vector2f(value.x() + 10.f * scale(), baseline * (value.y() - unit_height)),
                     style::text_muted, figure.unit);
        at_.y() += value.y();
    }

    void at_bottom(TextStyle style, style::Color color, std::string_view words) {
        at_.y() = room_.max_px.y() - canvas_.text_size_px(style, words, room_.size_px().x()).y();
        text(style, 0.f, color, words);
    }

    void rule() { canvas_.line(at_, {room_.max_px.x(), at_.y()}, 1.5f * scale(), style::rule); }

    /// The middle of the mark in front of a line of text.
    Eigen::Vector2f bullet(TextStyle style) const {
        return at_ + Eigen::Vector2f(13.f * scale(), 0.5f * canvas_.text_size_px(style, "T").y());
    }

  private:
    Canvas& canvas_;
    DisplayRect room_;
    Eigen::Vector2f at_;
};

void draw_finger_dots(Canvas& canvas, const Eigen::Vector2f& at, const std::vector<int>& touching) {
    const float s = canvas.scale();
    Eigen::Vector2f center = at + Eigen::Vector2f(10.f * s, 10.f * s);
    for (const int id : touching) {
        canvas.disc(center, 9.f * s, style::finger_color(id));
        center.x() += 28.f * s;
    }
}

void draw_column(Canvas& canvas, const DisplayRect& room, const StatusWords& words) {
    Column column(canvas, room);
    column.space(4.f);
    draw_mark(canvas, column.bullet(TextStyle::title), 12.f * canvas.scale());
    column.text(TextStyle::title, indent_px, style::text, product_name);
    column.space(24.f);
    column.rule();
    column.space(24.f);
    draw_state_dot(canvas, column.bullet(TextStyle::heading), words.state.color);
    column.text(TextStyle::heading, indent_px, style::text, words.state.word);
    column.space(6.f);
    column.text(TextStyle::body, indent_px, style::text_muted, words.invitation);
    column.space(32.f);
    for (const Figure& figure : words.figures) {
        column.figure(figure);
        column.space(6.f);
    }
    column.space(8.f);
    draw_finger_dots(canvas, column.at(), words.touching);
    if (!words.note.empty()) column.at_bottom(TextStyle::body, style::warning, words.note);
}

/// Lays words out in a line from the left, on the room's middle.
class Row {
  public:
    Row(Canvas& canvas, const DisplayRect& room) : canvas_(canvas), room_(room), x_px_(room.min_px.x()) {}

    Eigen::Vector2f at() const { return {x_px_, room_.center_px().y()}; }
    float left_px() const { return room_.max_px.x() - x_px_; }
    void space(float px) { x_px_ += px * canvas_.scale(); }
    void to_right_end(float width_px) { x_px_ = room_.max_px.x() - width_px; }

    void text(TextStyle style, style::Color color, std::string_view words) {
        const Eigen::Vector2f size = canvas_.text_size_px(style, words);
        canvas_.text(style, {x_px_, at().y() - 0.5f * size.y()}, color, words);
        x_px_ += size.x();
    }

  private:
    Canvas& canvas_;
    DisplayRect room_;
    float x_px_;
};

float figures_width_px(const Canvas& canvas, const StatusWords& words) {
    float width_px = 0.f;
    for (const Figure& figure : words.figures)
        width_px +=
            canvas.text_size_px(TextStyle::body, figure.value + figure.unit).x() + 26.f * canvas.scale();
    return width_px;
}

/// What does not fit is left out: first the product's name, then the figures.
void draw_bar(Canvas& canvas, const DisplayRect& room, const StatusWords& words) {
    const float s = canvas.scale();
    Row row(canvas, room);
    draw_state_dot(canvas, row.at() + Eigen::Vector2f(10.f * s, 0.f), words.state.color);
    row.space(30.f);
    row.text(TextStyle::heading, style::text, words.state.word);
    row.space(26.f);
    const float note_px = canvas.text_size_px(TextStyle::body, words.note).x();
    if (figures_width_px(canvas, words) + note_px <= row.left_px())
        for (const Figure& figure : words.figures) {
            row.text(TextStyle::body, style::text, figure.value);
            row.space(6.f);
            row.text(TextStyle::body, style::text_muted, figure.unit);
            row.space(20.f);
        }
    row.text(TextStyle::body, style::warning, words.note);

    const float name_px = canvas.text_size_px(TextStyle::body, product_name).x();
    if (row.left_px() < name_px + 48.f * s) return;
    row.to_right_end(name_px);
    draw_mark(canvas, row.at() - Eigen::Vector2f(18.f * s, 0.f), 9.f * s);
    row.text(TextStyle::body, style::text, product_name);
}

}  // namespace

void draw_status_panel(Canvas& canvas, const Layout& layout, const StatusWords& words) {
    if (layout.panel_beside)
        draw_column(canvas, layout.panel, words);
    else
        draw_bar(canvas, layout.panel, words);
}

void draw_status_note(Canvas& canvas, const Layout& layout, const StatusWords& words) {
    if (words.note.empty()) return;
    const Eigen::Vector2f room = note_room_px * canvas.scale() * Eigen::Vector2f(1.f, 0.6f);
    const Eigen::Vector2f at = layout.panel.min_px + room;
    const float wrap_px = layout.panel.size_px().x() - 2.f * room.x();
    const Eigen::Vector2f size = canvas.text_size_px(TextStyle::body, words.note, wrap_px);
    canvas.box(at - room, at + size + room, style::corner_px * canvas.scale(), style::card);
    canvas.text(TextStyle::body, at, style::warning, words.note, wrap_px);
}

}  // namespace touchstone
