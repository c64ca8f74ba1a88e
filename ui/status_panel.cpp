#include "ui/status_panel.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace touchstone {

namespace {

struct StateRow {
    std::string_view state;
    StateLook look;
};

constexpr std::array<StateRow, 5> states{{{"starting", {"Starting", style::accent}},
                                          {"scanning", {"Scanning", style::accent}},
                                          {"live", {"Live", style::good}},
                                          {"realigning", {"Realigning", style::warning}},
                                          {"sensor_lost", {"No camera", style::bad}}}};

std::string one_decimal(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", static_cast<double>(value));
    return text;
}

std::string count_of_touches(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " touch" : " touches");
}

/// The maker's mark: a touch on a surface, seen from above.
void draw_mark(Canvas& canvas, Eigen::Vector2f center, float radius) {
    canvas.ring(center, radius, 0.2f * radius, style::accent.faded(0.45f));
    canvas.disc(center, 0.45f * radius, style::accent);
}

/// Lays out a column from the top down; each call moves on.
class Column {
  public:
    Column(Canvas& canvas, const DisplayRect& room) : canvas_(canvas), room_(room), at_(room.min_px) {}

    void space(float px) { at_.y() += px * canvas_.scale(); }

    void text(TextStyle style, style::Color color, std::string_view words) {
        const float wrap = room_.size_px().x();
        canvas_.text(style, at_, color, words, wrap);
        at_.y() += canvas_.text_size_px(style, words, wrap).y();
    }

    void figure(const std::string& value, std::string_view unit) {
        canvas_.text(TextStyle::figure, at_, style::text, value);
        const Eigen::Vector2f size = canvas_.text_size_px(TextStyle::figure, value);
        const float unit_height = canvas_.text_size_px(TextStyle::body, unit).y();
        canvas_.text(
            TextStyle::body,
            at_ + Eigen::Vector2f(size.x() + 10.f * canvas_.scale(), 0.83f * size.y() - 0.83f * unit_height),
            style::text_muted, unit);
        at_.y() += size.y();
    }

    Eigen::Vector2f& at() { return at_; }

  private:
    Canvas& canvas_;
    DisplayRect room_;
    Eigen::Vector2f at_;
};

void draw_name(Canvas& canvas, Column& column) {
    const float s = canvas.scale();
    const float height = canvas.text_size_px(TextStyle::title, "T").y();
    draw_mark(canvas, column.at() + Eigen::Vector2f(13.f * s, 0.5f * height), 12.f * s);
    canvas.text(TextStyle::title, column.at() + Eigen::Vector2f(36.f * s, 0.f), style::text, "Touchstone");
    column.at().y() += height;
}

void draw_state(Canvas& canvas, Column& column, const StateLook& look) {
    const float s = canvas.scale();
    const float height = canvas.text_size_px(TextStyle::heading, look.word).y();
    canvas.disc(column.at() + Eigen::Vector2f(13.f * s, 0.5f * height), 10.f * s, look.color.faded(0.22f));
    canvas.disc(column.at() + Eigen::Vector2f(13.f * s, 0.5f * height), 5.5f * s, look.color);
    canvas.text(TextStyle::heading, column.at() + Eigen::Vector2f(36.f * s, 0.f), style::text, look.word);
    column.at().y() += height;
}

void draw_finger_dots(Canvas& canvas, Column& column, const std::map<int, Fingertip>& touching) {
    const float s = canvas.scale();
    Eigen::Vector2f center = column.at() + Eigen::Vector2f(9.f * s, 10.f * s);
    for (const auto& [id, tip] : touching) {
        canvas.disc(center, 8.f * s, style::finger_color(id));
        center.x() += 26.f * s;
    }
    column.at().y() += 20.f * s;
}

void draw_rule(Canvas& canvas, Column& column, float width_px) {
    canvas.line(column.at(), column.at() + Eigen::Vector2f(width_px, 0.f), 1.5f * canvas.scale(),
                style::rule);
}

void draw_column(Canvas& canvas, const DisplayRect& room, const TableFrame& frame, const PanelWords& words) {
    Column column(canvas, room);
    column.space(4.f);
    draw_name(canvas, column);
    column.space(26.f);
    draw_rule(canvas, column, room.size_px().x());
    column.space(26.f);
    draw_state(canvas, column, state_look(frame.state));
    column.space(10.f);
    if (frame.state == "live") column.text(TextStyle::body, style::text_muted, words.invitation);
    column.space(34.f);
    column.figure(one_decimal(frame.frame_rate_hz), "frames / s");
    column.space(8.f);
    column.figure(one_decimal(frame.frame_ms), "ms a frame");
    column.space(8.f);
    column.figure(std::to_string(words.touching.size()), words.touching.size() == 1 ? "touch" : "touches");
    column.space(10.f);
    draw_finger_dots(canvas, column, words.touching);
    if (frame.note.empty()) return;
    const float height = canvas.text_size_px(TextStyle::body, frame.note, room.size_px().x()).y();
    column.at().y() = room.max_px.y() - height;
    column.text(TextStyle::body, style::warning, frame.note);
}

void draw_bar(Canvas& canvas, const DisplayRect& room, const TableFrame& frame, const PanelWords& words) {
    const float s = canvas.scale();
    const float middle = room.center_px().y();
    const StateLook look = state_look(frame.state);
    const std::string figures = one_decimal(frame.frame_rate_hz) + " frames / s    " +
                                one_decimal(frame.frame_ms) + " ms    " +
                                count_of_touches(words.touching.size());
    const auto put = [&](TextStyle style, float x, style::Color color, std::string_view text) {
        const Eigen::Vector2f size = canvas.text_size_px(style, text);
        canvas.text(style, {x, middle - 0.5f * size.y()}, color, text);
        return x + size.x();
    };
    float x = room.min_px.x();
    canvas.disc({x + 10.f * s, middle}, 10.f * s, look.color.faded(0.22f));
    canvas.disc({x + 10.f * s, middle}, 5.5f * s, look.color);
    x = put(TextStyle::heading, x + 30.f * s, style::text, look.word);
    x = put(TextStyle::body, x + 24.f * s, style::text_muted, figures);
    if (!frame.note.empty()) x = put(TextStyle::body, x + 24.f * s, style::warning, frame.note);

    const float name_width = canvas.text_size_px(TextStyle::body, "Touchstone").x();
    const float name_x = room.max_px.x() - name_width;
    if (x + 48.f * s > name_x) return;
    draw_mark(canvas, {name_x - 18.f * s, middle}, 9.f * s);
    put(TextStyle::body, name_x, style::text, "Touchstone");
}

}  // namespace

StateLook state_look(std::string_view state) {
    const auto row =
        std::find_if(states.begin(), states.end(), [&](const StateRow& r) { return r.state == state; });
    return row != states.end() ? row->look : StateLook{state, style::text_muted};
}

void draw_status_panel(Canvas& canvas, const Layout& layout, const TableFrame& frame,
                       const PanelWords& words) {
    if (layout.panel_beside)
        draw_column(canvas, layout.panel, frame, words);
    else
        draw_bar(canvas, layout.panel, frame, words);
}

}  // namespace touchstone
