#include "platform/system/stage_timer.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(StageTimes, SummarizesEachStageOverItsFrames) {
    StageTimes times;
    for (int i = 1; i <= 100; ++i) {
        times.add("raycast", i);
        times.end_frame();
    }
    const StageSummary raycast = times.summary("raycast");
    EXPECT_DOUBLE_EQ(raycast.median_ms, 50.5);
    EXPECT_NEAR(raycast.p99_ms, 99.01, 1e-9);
    EXPECT_EQ(raycast.frames, 100u);
}

TEST(StageTimes, SumsAStageThatRunsTwiceAFrame) {
    StageTimes times;
    times.add("raycast", 2.0);
    times.add("raycast", 3.0);
    times.end_frame();
    EXPECT_DOUBLE_EQ(times.summary("raycast").median_ms, 5.0);
    EXPECT_EQ(times.summary("raycast").frames, 1u);
}

TEST(StageTimes, RemembersTheLastFramesOnly) {
    StageTimes times(3);
    for (double ms : {100.0, 100.0, 1.0, 2.0, 3.0}) {
        times.add("icp", ms);
        times.end_frame();
    }
    EXPECT_DOUBLE_EQ(times.summary("icp").median_ms, 2.0);
    EXPECT_EQ(times.summary("icp").frames, 3u);
}

TEST(StageTimes, GivesNoSampleToAStageThatDidNotRun) {
    StageTimes times;
    times.add("convert", 1.0);
    times.add("touch", 4.0);
    times.end_frame();
    times.add("convert", 1.0);
    times.end_frame();
    EXPECT_EQ(times.summary("convert").frames, 2u);
    EXPECT_EQ(times.summary("touch").frames, 1u);
    EXPECT_EQ(times.summary("unknown").frames, 0u);
}

TEST(StageTimes, KeepsTheOrderOfFirstRun) {
    StageTimes times;
    times.add("convert", 1.0);
    times.add("track", 1.0);
    times.end_frame();
    ASSERT_EQ(times.summary().size(), 2u);
    EXPECT_EQ(times.summary()[0].stage, "convert");
    EXPECT_EQ(times.summary()[1].stage, "track");
    times.clear();
    EXPECT_TRUE(times.summary().empty());
}

TEST(StageTimer, AddsTheTimeOfItsScope) {
    StageTimes times;
    { const StageTimer timer(times, "scope"); }
    times.end_frame();
    EXPECT_EQ(times.summary("scope").frames, 1u);
    EXPECT_GE(times.summary("scope").median_ms, 0.0);
}

}  // namespace
}  // namespace touchstone
