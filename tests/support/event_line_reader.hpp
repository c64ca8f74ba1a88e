#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "platform/output/touch_sink.hpp"

namespace touchstone {

inline ReportedFinger finger_of(const nlohmann::json& object) {
    ReportedFinger finger;
    finger.id = object.at("id");
    const std::string phase = object.value("phase", "move");
    finger.phase = phase == "down" ? ReportedPhase::down
                   : phase == "up" ? ReportedPhase::up
                                   : ReportedPhase::move;
    finger.camera_mm = object.at("camera_mm");
    finger.surface = object.at("surface");
    finger.height_mm = object.at("height_mm");
    return finger;
}

/// The report that a line of the event log tells.
inline TouchReport report_of(const std::string& event_line) {
    const auto line = nlohmann::json::parse(event_line);
    TouchReport report;
    report.frame = line.at("frame");
    report.time_us = line.at("time_us");
    report.state = line.at("state");
    for (const auto& touch : line.at("touches")) report.touches.push_back(finger_of(touch));
    for (const auto& hover : line.at("hovers")) report.hovers.push_back(finger_of(hover));
    return report;
}

}  // namespace touchstone
