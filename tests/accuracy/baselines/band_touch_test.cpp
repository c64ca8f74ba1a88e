#include "tests/accuracy/baselines/band_touch.hpp"

#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

constexpr Block fingertip{20, 10, 9, 9};

/// Whether a fingertip so many millimetres over the learnt surface is a touch.
bool touches_at(const BandTouchConfig& config, int height_mm, const Block& block = fingertip) {
    BandTouch method(config);
    show_surface(method);
    const auto touches = method.process(with_block(level_picture(), block, height_mm));
    return !touches.empty();
}

TEST(BandTouch, EachMethodHasItsBand) {
    for (int mm = 0; mm <= 40; ++mm) {
        EXPECT_EQ(touches_at(wilson_single(), mm), mm >= 6 && mm <= 12) << mm << " mm";
        EXPECT_EQ(touches_at(wilson_max(), mm), mm >= 8 && mm <= 16) << mm << " mm";
        EXPECT_EQ(touches_at(wilson_stat(), mm), mm > 0 && mm < 20) << mm << " mm without any spread";
        EXPECT_EQ(touches_at(kinect_touch(), mm), mm > 10 && mm < 20) << mm << " mm";
    }
}

TEST(BandTouch, TheStatisticOneAsksForFourSpreads) {
    BandTouch method(wilson_stat());
    for (int i = 0; i < 100; ++i)
        method.process(DepthPicture(64, 48, static_cast<std::uint16_t>(i % 2 == 0 ? 998 : 1002)));
    EXPECT_TRUE(method.process(with_block(level_picture(), fingertip, 8)).empty()) << "four spreads of 2 mm";
    EXPECT_FALSE(method.process(with_block(level_picture(), fingertip, 9)).empty());
}

TEST(BandTouch, TheTunedOneTakesNoStepForAFinger) {
    EXPECT_FALSE(touches_at(wilson_stat_for_steps(), 4)) << "4 x (0 + 1) mm";
    EXPECT_TRUE(touches_at(wilson_stat_for_steps(), 5));
    EXPECT_FALSE(touches_at(wilson_stat_for_steps(), 20));
}

TEST(BandTouch, TheirBackgroundIsThatOfTheirFrames) {
    BandTouch single(wilson_single());
    for (int i = 1; i <= 30; ++i)
        single.process(DepthPicture(64, 48, static_cast<std::uint16_t>(i == 30 ? 1000 : 1500)));
    EXPECT_FALSE(single.process(with_block(level_picture(), fingertip, 9)).empty());
    BandTouch largest(wilson_max());
    for (int i = 1; i <= 16; ++i)
        largest.process(DepthPicture(64, 48, static_cast<std::uint16_t>(i == 3 ? 1003 : 1000)));
    EXPECT_TRUE(largest.process(with_block(level_picture(), fingertip, 4)).empty())
        << "7 mm over the largest";
    EXPECT_FALSE(largest.process(with_block(level_picture(), fingertip, 5)).empty());
}

TEST(BandTouch, TheTouchIsAtTheMiddleOfTheBlobAndKeepsItsId) {
    BandTouch method(wilson_single());
    show_surface(method);
    const auto first = method.process(with_block(level_picture(), fingertip, 9));
    ASSERT_EQ(first.size(), 1U);
    EXPECT_EQ(first.front().pixel_px, Eigen::Vector2d(24.0, 14.0));
    const auto moved = method.process(with_block(level_picture(), {30, 10, 9, 9}, 9));
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_EQ(moved.front().id, first.front().id);
}

TEST(BandTouch, KinectTouchAsksForMoreThanFiftyPixels) {
    EXPECT_FALSE(touches_at(kinect_touch(), 15, {20, 10, 10, 5}));
    EXPECT_TRUE(touches_at(kinect_touch(), 15, {20, 10, 4, 13}));
}

}  // namespace
}  // namespace touchstone::baselines
