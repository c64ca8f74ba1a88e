#include "ui/scenes/scan_progress.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace touchstone {

namespace {

constexpr float ring_radius_px = 36.f;
constexpr float padding_px = 24.f;
constexpr float line_gap_px = 6.f;
constexpr float least_wrap_px = 160.f;
constexpr float above_edge_px = 40.f;

struct CardLine {
    TextStyle style;
    style::Color color;
    std::string words;
};

struct CardWords {
    const char* title;
    const char* line;
};

CardWords words_for(const std::string& state) {
    if (state == "scanning") return {"Scanning the surroundings", "Keep the table clear for a moment"};
    if (state == "sensor_lost") return {"Camera disconnected", "Waiting for it to come back"};
    if (state == "realigning") return {"The camera was moved", "Finding its new place"};
    return {"Starting", "Waiting for the depth camera"};
}

/// The frame's note is better informed than our second line and takes its place.
std::vector<CardLine> card_lines(const TableFrame& frame) {
    const CardWords words = words_for(frame.state);
    std::vector<CardLine> lines{
        {TextStyle::heading, style::text, words.title},
        {TextStyle::body, style::text_muted, frame.note.empty() ? words.line : frame.note}};
    if (frame.state == "scanning" && frame.scan_frames_wanted > 0)
        lines.push_back({TextStyle::caption, style::text_muted.faded(0.8f),
                         "Frame " + std::to_string(frame.scan_frames_done) + " of " +
                             std::to_string(frame.scan_frames_wanted)});
    return lines;
}

Eigen::Vector2f size_of(const Canvas& canvas, const std::vector<CardLine>& lines, float wrap_px) {
    Eigen::Vector2f size(0.f, line_gap_px * canvas.scale() * static_cast<float>(lines.size() - 1));
    for (const CardLine& line : lines) {
        const Eigen::Vector2f each = canvas.text_size_px(line.style, line.words, wrap_px);
        size = {std::max(size.x(), each.x()), size.y() + each.y()};
    }
    return size;
}

std::string percent(float part) { return std::to_string(static_cast<int>(std::floor(100.f * part))) + "%"; }

void draw_ring(Canvas& canvas, const Eigen::Vector2f& center, float radius, const TableFrame& frame,
               float clock_s) {
    const float width = 6.f * canvas.scale();
    canvas.ring(center, radius, width, style::white.faded(0.12f));
    if (frame.state == "scanning") {
        const float progress = std::clamp(frame.scan_progress, 0.f, 1.f);
        if (progress > 0.f) canvas.arc(center, radius, width, 0.f, progress, style::accent);
        const std::string words = percent(progress);
        const Eigen::Vector2f size = canvas.text_size_px(TextStyle::body, words);
        canvas.text(TextStyle::body, center - 0.5f * size, style::text, words);
    } else {
        const float turn = std::fmod(0.7f * clock_s, 1.f);
        canvas.arc(center, radius, width, turn, turn + 0.25f, style::accent);
    }
}

}  // namespace

bool is_waiting_state(const TableFrame& frame) { return frame.state != "live"; }

void draw_scan_progress(Canvas& canvas, const DisplayRect& view, const TableFrame& frame, float clock_s) {
    const float s = canvas.scale();
    const float radius = ring_radius_px * s;
    const float padding = padding_px * s;
    const std::vector<CardLine> lines = card_lines(frame);
    const float wrap = std::max(least_wrap_px * s, view.size_px().x() - 5.f * padding - 2.f * radius);
    const Eigen::Vector2f words = size_of(canvas, lines, wrap);
    const Eigen::Vector2f half(radius + 1.5f * padding + 0.5f * words.x(),
                               padding + std::max(radius, 0.5f * words.y()));
    Eigen::Vector2f center = view.center_px();
    if (frame.view) center.y() = view.max_px.y() - above_edge_px * s - half.y();

    const Eigen::Vector2f border = Eigen::Vector2f::Constant(s);
    canvas.box(center - half - border, center + half + border, style::corner_px * s, style::rule);
    canvas.box(center - half, center + half, style::corner_px * s, style::card);
    draw_ring(canvas, {center.x() - half.x() + padding + radius, center.y()}, radius, frame, clock_s);
    Eigen::Vector2f at(center.x() - half.x() + 2.f * (padding + radius), center.y() - 0.5f * words.y());
    for (const CardLine& line : lines) {
        canvas.text(line.style, at, line.color, line.words, wrap);
        at.y() += canvas.text_size_px(line.style, line.words, wrap).y() + line_gap_px * s;
    }
}

}  // namespace touchstone
