#include "ui/scenes/scan_progress.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace touchstone {

namespace {

struct CardWords {
    std::string title;
    std::string line;
};

CardWords words_for(const TableFrame& frame) {
    if (frame.state == "scanning")
        return {"Scanning the surroundings",
                frame.note.empty() ? "Keep the table clear for a moment" : frame.note};
    if (frame.state == "sensor_lost")
        return {"Camera disconnected", frame.note.empty() ? "Waiting for it to come back" : frame.note};
    if (frame.state == "realigning")
        return {"The camera was moved", frame.note.empty() ? "Finding its new place" : frame.note};
    return {"Starting", frame.note.empty() ? "Waiting for the depth camera" : frame.note};
}

std::string percent(float part) { return std::to_string(static_cast<int>(std::floor(100.f * part))) + "%"; }

void draw_ring(Canvas& canvas, Eigen::Vector2f center, float radius, const TableFrame& frame, float clock_s) {
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

std::string frame_count(const TableFrame& frame) {
    if (frame.state != "scanning" || frame.scan_frames_wanted <= 0) return "";
    return "Frame " + std::to_string(frame.scan_frames_done) + " of " +
           std::to_string(frame.scan_frames_wanted);
}

}  // namespace

bool is_waiting_state(const TableFrame& frame) { return frame.state != "live"; }

void draw_scan_progress(Canvas& canvas, const DisplayRect& view, const TableFrame& frame, float clock_s) {
    const float s = canvas.scale();
    const CardWords words = words_for(frame);
    const std::string count = frame_count(frame);
    const float ring_radius = 36.f * s;
    const float padding = 24.f * s;
    const float wrap = std::max(160.f * s, view.size_px().x() - 4.f * padding - 2.f * ring_radius - 48.f * s);
    const Eigen::Vector2f title = canvas.text_size_px(TextStyle::heading, words.title, wrap);
    const Eigen::Vector2f line = canvas.text_size_px(TextStyle::body, words.line, wrap);
    const float count_height = count.empty() ? 0.f : 24.f * s;
    const float text_height = title.y() + 8.f * s + line.y() + count_height;

    const Eigen::Vector2f size(2.f * ring_radius + 3.f * padding + std::max(title.x(), line.x()),
                               std::max(2.f * ring_radius, text_height) + 2.f * padding);
    const Eigen::Vector2f center(view.center_px().x(), view.max_px.y() - 40.f * s - 0.5f * size.y());
    const Eigen::Vector2f min = center - 0.5f * size;
    canvas.box(min - Eigen::Vector2f(1.f, 1.f), min + size + Eigen::Vector2f(1.f, 1.f), style::corner_px * s,
               style::rule);
    canvas.box(min, min + size, style::corner_px * s, style::card);
    draw_ring(canvas, {min.x() + padding + ring_radius, center.y()}, ring_radius, frame, clock_s);

    Eigen::Vector2f at(min.x() + 2.f * padding + 2.f * ring_radius, center.y() - 0.5f * text_height);
    canvas.text(TextStyle::heading, at, style::text, words.title, wrap);
    at.y() += title.y() + 8.f * s;
    canvas.text(TextStyle::body, at, style::text_muted, words.line, wrap);
    at.y() += line.y() + 6.f * s;
    if (!count.empty()) canvas.text(TextStyle::caption, at, style::text_muted.faded(0.8f), count);
}

}  // namespace touchstone
