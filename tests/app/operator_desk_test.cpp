#include "app/operator_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using testing::HasSubstr;

TEST(OperatorDesk, TellsWhatWasAskedForSinceTheLastWish) {
    OperatorDesk desk;
    EXPECT_EQ(desk.take({true, 1, 0, 0}).rescans, 1);
    EXPECT_TRUE(desk.is_open());
    const OperatorWish next = desk.take({false, 1, 2, 1});
    EXPECT_EQ(next.rescans, 0);
    EXPECT_EQ(next.recalibrations, 2);
    EXPECT_EQ(next.recordings, 1);
    EXPECT_FALSE(desk.is_open());
    EXPECT_EQ(desk.take({false, 0, 0, 0}).rescans, 0) << "another display counts anew";
    EXPECT_EQ(desk.take({false, 1, 0, 0}).rescans, 1);
}

TEST(OperatorDesk, KeepsTheLastFiveFaults) {
    OperatorDesk desk;
    for (int i = 0; i < 7; ++i) desk.note_fault("silent", "reason " + std::to_string(i));
    const OperatorView view = desk.view({});
    ASSERT_EQ(view.faults.size(), 5U);
    EXPECT_THAT(view.faults.front(), testing::MatchesRegex("..:..:.. silent: reason 6"));
    EXPECT_THAT(view.faults.back(), HasSubstr("reason 2"));
}

TEST(OperatorDesk, ARecordingTakesTenSeconds) {
    using std::chrono::milliseconds;
    OperatorDesk desk;
    const OperatorDesk::Time start{};
    EXPECT_FALSE(desk.ends_recording(start));
    desk.begin_recording(start, "/faults");
    EXPECT_EQ(desk.view(start + milliseconds(6500)).recording, "Recording: 4 s to go");
    EXPECT_FALSE(desk.ends_recording(start + milliseconds(9999)));
    EXPECT_TRUE(desk.ends_recording(start + milliseconds(10000)));
    EXPECT_FALSE(desk.ends_recording(start + milliseconds(20000)));
    EXPECT_THAT(desk.view(start).recording, HasSubstr("/faults"));
}

TEST(OperatorDesk, SmallPictures) {
    DepthFrame frame;
    frame.width_px = 320;
    frame.height_px = 4;
    frame.depth_mm.assign(320 * 4, 1000);
    frame.depth_mm[0] = 0;
    frame.depth_mm[2] = 600;
    const Thumbnail depth = depth_thumbnail(frame);
    EXPECT_EQ(depth.size, (PixelSize{160, 2}));
    ASSERT_EQ(depth.gray.size(), 320U);
    EXPECT_EQ(depth.gray[0], 0) << "nothing measured";
    EXPECT_EQ(depth.gray[1], 255) << "the nearest";
    EXPECT_EQ(depth.gray[2], 60) << "the farthest";
    std::vector<std::uint8_t> map(320 * 4, 0);
    map[4] = 7;
    const Thumbnail mask = mask_thumbnail(map, {320, 4});
    EXPECT_EQ(mask.gray[1], 0);
    EXPECT_EQ(mask.gray[2], 255);
    frame.depth_mm.assign(320 * 4, 0);
    EXPECT_EQ(depth_thumbnail(frame).gray[5], 0);
}

}  // namespace
}  // namespace touchstone
