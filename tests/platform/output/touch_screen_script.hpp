#pragma once

#include <linux/input.h>
#include <ostream>
#include <vector>

#include "platform/output/touch_screen_events.hpp"

namespace touchstone {

inline void PrintTo(const InputEvent& event, std::ostream* out) {
    *out << event.type << '/' << event.code << '=' << event.value;
}

/// A report, and the events of the screen of 400 mm by 300 mm that follow from it.
struct TouchScreenStep {
    const char* what;
    std::vector<ReportedFinger> touches;
    std::vector<InputEvent> events;
};

inline constexpr TouchScreenConfig scripted_screen{.slots = 3, .width_mm = 400, .height_mm = 300};

/// A tap, two fingers, an up and a down in one report, a tap within one report, more fingers than slots.
inline std::vector<TouchScreenStep> touch_screen_script() {
    constexpr auto down = ReportedPhase::down, move = ReportedPhase::move, up = ReportedPhase::up;
    const auto finger = [](int id, ReportedPhase phase, double u, double v) {
        return ReportedFinger{.id = id, .phase = phase, .surface = {u, v}};
    };
    const auto slot = [](int value) { return InputEvent{EV_ABS, ABS_MT_SLOT, value}; };
    const auto id = [](int value) { return InputEvent{EV_ABS, ABS_MT_TRACKING_ID, value}; };
    const auto mt_x = [](int value) { return InputEvent{EV_ABS, ABS_MT_POSITION_X, value}; };
    const auto mt_y = [](int value) { return InputEvent{EV_ABS, ABS_MT_POSITION_Y, value}; };
    const auto x = [](int value) { return InputEvent{EV_ABS, ABS_X, value}; };
    const auto y = [](int value) { return InputEvent{EV_ABS, ABS_Y, value}; };
    const auto touch = [](int value) { return InputEvent{EV_KEY, BTN_TOUCH, value}; };
    const InputEvent syn{EV_SYN, SYN_REPORT, 0};
    return {
        {"a tap begins",
         {finger(3, down, 0.25, 0.5)},
         {id(1), mt_x(1000), mt_y(1500), touch(1), x(1000), y(1500), syn}},
        {"and is still", {finger(3, move, 0.25, 0.5)}, {}},
        {"and ends", {finger(3, up, 0.25, 0.5)}, {id(-1), touch(0), syn}},
        {"nobody touches", {}, {}},
        {"the same place again, which slot and pointer have still",
         {finger(3, down, 0.25, 0.5)},
         {id(2), touch(1), syn}},
        {"a second finger; the first goes aside",
         {finger(3, move, 0.5, 0.5), finger(4, down, 0.75, 0.1)},
         {mt_x(2000), slot(1), id(3), mt_x(3000), mt_y(300), x(2000), syn}},
        {"only the second moves: not the pointer",
         {finger(3, move, 0.5, 0.5), finger(4, move, 0.75, 0.2)},
         {mt_y(600), syn}},
        {"the first ends: the second is the pointer",
         {finger(4, move, 0.75, 0.2)},
         {slot(0), id(-1), x(3000), y(600), syn}},
        {"one finger ends and begins in a report: another contact in another slot",
         {finger(4, up, 0.75, 0.2), finger(4, down, 0.75, 0.3)},
         {slot(1), id(-1), slot(0), id(4), mt_x(3000), mt_y(900), y(900), syn}},
        {"a tap within a report is two frames",
         {finger(4, move, 0.75, 0.3), finger(5, down, 0.5, 0.5), finger(5, up, 0.5, 0.5)},
         {slot(1), id(5), mt_x(2000), mt_y(1500), syn, id(-1), syn}},
        {"four fingers where there are three slots; beyond the edge is the edge",
         {finger(4, move, 0.75, 0.3), finger(6, down, 0.0, 0.0), finger(7, down, 1.2, 1.0),
          finger(8, down, 0.5, 0.5)},
         {id(6), mt_x(0), mt_y(0), slot(2), id(7), mt_x(4000), mt_y(3000), syn}},
        {"a slot is free: not for the finger that found none",
         {finger(4, move, 0.75, 0.3), finger(7, move, 1.0, 1.0), finger(8, move, 0.5, 0.4)},
         {slot(1), id(-1), syn}},
        {"an area that the table no longer has", {}, {slot(0), id(-1), slot(2), id(-1), touch(0), syn}},
    };
}

}  // namespace touchstone
