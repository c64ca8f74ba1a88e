#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/accuracy/soak_run.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

TrueTip tip_at(double gap_mm) { return {0, 0, gap_mm, {0.0, 0.0, 1000.0}}; }

TEST(SoakGaps, WhatHappensAroundAFaultIsNobodysTouch) {
    TouchTruth truth;
    TouchLog log;
    for (int frame = 0; frame < 300; ++frame) {
        truth.tips.push_back({tip_at(0.0)});
        log[frame] = {{1, {0.0, 0.0, 1000.0}}};
    }
    leave_out_gaps({{-1, 20}, {150, 160}}, truth, log);
    const auto is_left = [&](int frame) {
        EXPECT_EQ(log.contains(frame), !truth.tips[static_cast<std::size_t>(frame)].empty()) << frame;
        return log.contains(frame);
    };
    EXPECT_FALSE(is_left(0));
    EXPECT_FALSE(is_left(65));
    EXPECT_TRUE(is_left(66));
    EXPECT_TRUE(is_left(104));
    EXPECT_FALSE(is_left(105));
    EXPECT_FALSE(is_left(205));
    EXPECT_TRUE(is_left(206));
}

TEST(SoakText, SaysWhatCounts) {
    SoakScore score;
    score.seconds = 600.0;
    score.frames = 17991;
    score.dropped = 9;
    score.samples = {{0.0, 200.0, 40, 0, 1.0}, {5.0, 201.0, 41, 150, 7.5}};
    EXPECT_THAT(text_of(score), HasSubstr("10.0 minutes, 17991 frames"));
    EXPECT_THAT(text_of(score), HasSubstr("9 dropped (0.050 %)"));
    const std::string script = gnuplot_script(score, "/tmp/soak.png");
    EXPECT_THAT(script, HasSubstr("0.083 30.000"));  // frames a second
    EXPECT_THAT(script, HasSubstr("0.083 7.500"));   // the lag
    EXPECT_THAT(script, HasSubstr("0.083 41.000"));  // open files
}

/// The short form: a busy machine drops frames, so that their number is not looked at.
TEST(Soak, ATableWithVisitorsAndFaultsEndsWell) {
    SoakRun run;
    run.program = TOUCHSTONE_PROGRAM;
    run.scene = "flat";
    run.minutes = 0.4;
    run.faults_every_s = 6.0;
    run.pause_s = 1.0;
    const SoakScore score = run_soak(run);
    EXPECT_EQ(score.exit_status, 0);
    EXPECT_GT(score.frames, 100);
    EXPECT_GE(score.faults, 1);
    EXPECT_GT(score.end_mb, 50.0);
    EXPECT_LT(score.end_mb, score.start_mb + 60.0);
    EXPECT_LE(score.end_files, score.start_files + 4);
    EXPECT_FALSE(score.samples.empty());
}

}  // namespace
}  // namespace touchstone
