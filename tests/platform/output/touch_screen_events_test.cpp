#include "platform/output/touch_screen_events.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/platform/output/touch_screen_script.hpp"

namespace touchstone {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

ReportedFinger finger(int id, ReportedPhase phase) {
    return {.id = id, .phase = phase, .surface = {0.5, 0.5}};
}

TEST(TouchScreenEvents, AreThoseOfTheGoldenSequence) {
    TouchScreenEvents screen(scripted_screen);
    for (const TouchScreenStep& step : touch_screen_script())
        EXPECT_EQ(screen.frame(step.touches), step.events) << step.what;
    EXPECT_EQ(screen.left_out(), 1);
}

TEST(TouchScreenEvents, ReleaseLiftsAllOnce) {
    TouchScreenEvents screen({.slots = 2});
    screen.frame({finger(1, ReportedPhase::down), finger(2, ReportedPhase::down)});
    EXPECT_THAT(screen.release_all(),
                ElementsAre(InputEvent{EV_ABS, ABS_MT_SLOT, 0}, InputEvent{EV_ABS, ABS_MT_TRACKING_ID, -1},
                            InputEvent{EV_ABS, ABS_MT_SLOT, 1}, InputEvent{EV_ABS, ABS_MT_TRACKING_ID, -1},
                            InputEvent{EV_KEY, BTN_TOUCH, 0}, InputEvent{EV_SYN, SYN_REPORT, 0}));
    EXPECT_THAT(screen.release_all(), IsEmpty());
}

TEST(TouchScreenEvents, TheOnlySlotIsFreedBeforeItIsTakenAgain) {
    TouchScreenEvents screen({.slots = 1});
    screen.frame({finger(1, ReportedPhase::down)});
    const auto events = screen.frame({finger(1, ReportedPhase::up), finger(1, ReportedPhase::down)});
    EXPECT_EQ(std::ranges::count(events, EV_SYN, &InputEvent::type), 2);
    EXPECT_EQ(screen.left_out(), 0);
}

TEST(TouchScreenEvents, TrackingIdsStayWithinTheirAxis) {
    TouchScreenEvents screen({.slots = 1});
    for (int i = 0; i < 70'000; ++i) {
        const auto events = screen.frame({finger(i, ReportedPhase::down)});
        const auto begun = std::ranges::find_if(events, [](const InputEvent& event) {
            return event.code == ABS_MT_TRACKING_ID && event.value >= 0;
        });
        ASSERT_NE(begun, events.end());
        ASSERT_LE(begun->value, 65535);
        screen.release_all();
    }
}

TEST(TouchScreenAxis, AUnitIsATenthOfAMillimetreWhereTheLengthIsKnown) {
    EXPECT_EQ(touch_screen_axis(640).largest, 6400);
    EXPECT_EQ(touch_screen_axis(640).units_per_mm, 10);
    EXPECT_EQ(touch_screen_axis(0).largest, 32767);
    EXPECT_EQ(touch_screen_axis(0).units_per_mm, 0);
}

}  // namespace
}  // namespace touchstone
