#include "platform/camera/frame_pairing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using ::testing::ElementsAre;

DepthFrame depth_at(std::uint64_t timestamp_us) {
    DepthFrame frame;
    frame.timestamp_us = timestamp_us;
    frame.width_px = frame.height_px = 1;
    frame.depth_mm = {1000};
    return frame;
}

ColorPicture color_at(std::uint64_t timestamp_us, std::uint8_t value) {
    return {timestamp_us, 1, 1, {value, value, value}};
}

TEST(FramePairing, LiveTakesWhatIsThere) {
    FramePairing pairing(false);
    EXPECT_FALSE(pairing.take());
    pairing.add(depth_at(100'000));
    const auto alone = pairing.take();
    ASSERT_TRUE(alone);
    EXPECT_TRUE(alone->color_rgb.empty());
    pairing.add(color_at(130'000, 1));
    pairing.add(color_at(140'000, 2));
    pairing.add(depth_at(133'000));
    EXPECT_THAT(pairing.take()->color_rgb, ElementsAre(1, 1, 1)) << "the nearest in time, not the newest";
}

TEST(FramePairing, ColorFarAwayInTimeIsNotTaken) {
    FramePairing pairing(false);
    pairing.add(color_at(100'000, 1));
    pairing.add(depth_at(150'001));
    EXPECT_TRUE(pairing.take()->color_rgb.empty());
}

TEST(FramePairing, APictureWithoutPixelsHidesAnOlderOne) {
    FramePairing pairing(false);
    pairing.add(color_at(100'000, 1));
    pairing.add(ColorPicture{133'000, 1, 1, {}});
    pairing.add(depth_at(133'000));
    EXPECT_TRUE(pairing.take()->color_rgb.empty());
}

TEST(FramePairing, ARecordingWaitsForItsColor) {
    FramePairing pairing(true);
    pairing.add(depth_at(100'000));
    EXPECT_FALSE(pairing.take());
    pairing.add(color_at(90'000, 1));
    EXPECT_FALSE(pairing.take()) << "a nearer one may come";
    pairing.add(color_at(123'000, 2));
    EXPECT_THAT(pairing.take()->color_rgb, ElementsAre(1, 1, 1));
}

TEST(FramePairing, ARecordingWhoseColorEndsEarlierStillGivesEachDepthFrameInOrder) {
    FramePairing pairing(true);
    std::vector<std::uint64_t> times;
    for (std::uint64_t i = 1; i <= 6; ++i) {
        pairing.add(depth_at(i * 33'000));
        while (auto frame = pairing.take()) times.push_back(frame->timestamp_us);
    }
    pairing.finish();
    while (auto frame = pairing.take()) times.push_back(frame->timestamp_us);
    EXPECT_THAT(times, ElementsAre(33'000, 66'000, 99'000, 132'000, 165'000, 198'000));
}

TEST(FramePairing, ScalingTakesTheNearestPixel) {
    const ColorPicture two{0, 2, 1, {1, 2, 3, 4, 5, 6}};
    EXPECT_THAT(scale_nearest(two, 1, 1), ElementsAre(4, 5, 6));
    EXPECT_THAT(scale_nearest(two, 2, 2), ElementsAre(1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6));
    EXPECT_THAT(scale_nearest(two, 3, 1), ElementsAre(1, 2, 3, 4, 5, 6, 4, 5, 6));
    EXPECT_TRUE(scale_nearest(ColorPicture{0, 2, 1, {}}, 4, 4).empty());
}

}  // namespace
}  // namespace touchstone
