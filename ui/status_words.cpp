#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "ui/scenes/scan_progress.hpp"
#include "ui/status_panel.hpp"

namespace touchstone {

namespace {

struct StateRow {
    std::string_view state;
    const char* word;
    style::Color color;
};

constexpr std::array<StateRow, 5> states{{{"starting", "Starting", style::accent},
                                          {"scanning", "Scanning", style::accent},
                                          {"live", "Live", style::good},
                                          {"realigning", "Realigning", style::warning},
                                          {"sensor_lost", "No camera", style::bad}}};

std::string one_decimal(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", static_cast<double>(value));
    return text;
}

}  // namespace

StateLook state_look(std::string_view state) {
    for (const StateRow& row : states)
        if (row.state == state) return {row.word, row.color};
    return {std::string(state), style::text_muted};
}

StatusWords status_words(const TableFrame& frame, std::string_view invitation,
                         const std::vector<int>& touching) {
    StatusWords words;
    words.state = state_look(frame.state);
    words.touching = touching;
    if (frame.frame_rate_hz > 0.f && (frame.state == "live" || frame.state == "scanning")) {
        words.figures.push_back({std::to_string(std::lround(frame.frame_rate_hz)), "frames / s"});
        words.figures.push_back({one_decimal(frame.frame_ms), "ms a frame"});
    }
    if (is_waiting_state(frame)) return words;
    words.figures.push_back({std::to_string(touching.size()), touching.size() == 1 ? "touch" : "touches"});
    words.invitation = invitation;
    words.note = frame.note;
    return words;
}

}  // namespace touchstone
