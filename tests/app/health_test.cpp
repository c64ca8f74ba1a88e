#include "app/health.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

using std::chrono::milliseconds;

const Health::Time start{std::chrono::hours(1)};

TEST(Health, CountsFramesThatTheCameraShouldHaveGiven) {
    Health health({}, start);
    for (const std::uint64_t time_us : {0U, 33'000U, 67'000U, 167'000U, 200'000U})
        health.frame(time_us, 30.0, 0);
    EXPECT_EQ(health.figures().frames, 5U);
    EXPECT_EQ(health.figures().missed_frames, 2U);
    health.frame(5'000'000, 30.0, 0);
    EXPECT_EQ(health.figures().missed_frames, 2U) << "a pause";
    health.frame(4'000'000, 30.0, 0);
    EXPECT_EQ(health.figures().missed_frames, 2U) << "a clock that was set back";
    health.camera_opened();
    health.frame(4'500'000, 30.0, 0);
    EXPECT_EQ(health.figures().missed_frames, 2U) << "another camera's clock";
}

int free_port() { return HealthPage(0).port(); }

TEST(Health, ReadsTheMachineOnceASecondForThePage) {
    HealthConfig config;
    config.port = free_port();
    Health health(config, start);
    health.tick(start, "scanning", 0.0, nullptr);
    EXPECT_EQ(health.figures().state, "scanning");
    EXPECT_GT(health.figures().resident_mb, 1.0);
    health.tick(start + milliseconds(900), "live", 30.0, nullptr);
    EXPECT_EQ(health.figures().state, "scanning");
    health.tick(start + milliseconds(1000), "live", 30.0, nullptr);
    EXPECT_EQ(health.figures().state, "live");
    EXPECT_DOUBLE_EQ(health.figures().frame_rate_hz, 30.0);
}

TEST(Health, ReadsTheMachineOnceAMinuteWithoutAPage) {
    Health health({}, start);
    health.tick(start + milliseconds(59'000), "live", 30.0, nullptr);
    EXPECT_EQ(health.figures().state, "");
    health.tick(start + milliseconds(60'000), "live", 30.0, nullptr);
    EXPECT_EQ(health.figures().state, "live");
    health.tick(start + milliseconds(119'000), "scanning", 30.0, nullptr);
    EXPECT_EQ(health.figures().state, "live");
}

TEST(Health, WhatMayHappenIsCountedFromTheStart) {
    const Health health({}, start);
    for (const char* kind : {"silent", "frozen", "blind", "torn", "lost", "clock"})
        EXPECT_EQ(health.figures().faults.at(kind), 0U) << kind;
    for (const char* what : {"stream", "camera", "usb"})
        EXPECT_EQ(health.figures().restarts.at(what), 0U) << what;
    for (const char* what : {"scan", "touch bias", "painting", "projector's calibration"})
        EXPECT_EQ(health.figures().unsaved.at(what), 0U) << what;
}

TEST(Health, TheLineTellsTheMinuteNotTheWhole) {
    HealthFigures before, now;
    before.frames = 1000;
    before.touches = 7;
    before.faults = {{"frozen", 3}};
    now = before;
    now.state = "live";
    now.frames = 2800;
    now.missed_frames = 4;
    now.touches = 19;
    before.lost_packets = 100;
    now.lost_packets = 107;
    now.faults["silent"] = 1;
    now.restarts["stream"] = 2;
    now.stages = {{"touches out", 6.0, 9.0, 300}, {"frame", 9.96, 14.2, 300}};
    now.resident_mb = 201.4;
    now.temperatures = {{"cpu-thermal", 61.5}};
    EXPECT_EQ(health_line(before, now, 60.0),
              "health: live, 1800 frames at 30.0 Hz, 4 missed, 12 touches, 1 faults and 2 restarts of the "
              "camera, 7 packets lost on USB, "
              "frame 10.0 ms (99 % 14.2), 201 MB, cpu-thermal 62 C");
}

TEST(Health, TheLineTellsWhatIsNotOnTheDisk) {
    Health health({}, start);
    EXPECT_EQ(health_line({}, health.figures(), 60.0).find("written"), std::string::npos);
    health.unsaved("scan");
    health.unsaved("painting");
    EXPECT_NE(health_line({}, health.figures(), 60.0).find(", 2 times something could not be written"),
              std::string::npos);
}

}  // namespace
}  // namespace touchstone
