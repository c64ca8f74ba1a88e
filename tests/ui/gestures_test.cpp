#include <cmath>

#include "gestures_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

TEST_F(GesturesTest, TapIsToldOnceWithPlaceAndTarget) {
    tap(1, on_one);
    frames(30);
    ASSERT_EQ(story(), "tap");
    EXPECT_EQ(every<Tap>()[0].place_px, on_one / mm_per_px);
    EXPECT_EQ(last().target, 1);
    EXPECT_EQ(last().fingers, 1);
}

TEST_F(GesturesTest, TapWaitsForADropOutAndNoLonger) {
    down(1, background);
    frame();
    up(1);
    wait(0);
    wait(80'000);
    EXPECT_EQ(story(), "");
    wait(1);
    EXPECT_EQ(story(), "tap");
    EXPECT_EQ(last().target, std::nullopt);
}

TEST_F(GesturesTest, TapWithinOneUpdateIsATap) {
    down(1, background);
    now_us_ += 100'000;
    up(1);
    wait(200'000);
    EXPECT_EQ(story(), "tap");
}

TEST_F(GesturesTest, SecondTapIsADoubleTapAndAThirdBeginsAnew) {
    tap(1, background);
    frames(3);
    EXPECT_EQ(story(), "tap");
    tap(1, background + Vector2f(5.f, 0.f));
    frames(3);
    EXPECT_EQ(story(), "tap, double tap");
    tap(1, background);
    frames(3);
    EXPECT_EQ(story(), "tap, double tap, tap");
}

TEST_F(GesturesTest, DoubleTapEndsAtItsTimeAndRadius) {
    const auto story_of = [](std::uint64_t gap_us, float apart_mm) {
        GestureRecognizer recognizer(config());
        std::string result;
        std::uint64_t t = 0;
        for (const float x_mm : {0.f, apart_mm}) {
            TouchEvent event;
            event.tip.pixel_px = {x_mm / mm_per_px, 0.f};
            recognizer.on_touch(event, t);
            event.phase = TouchPhase::up;
            recognizer.on_touch(event, t += 50'000);
            t += gap_us;
        }
        for (const Gesture& gesture : recognizer.update(t + 1'000'000))
            result += std::holds_alternative<DoubleTap>(gesture.what) ? "double " : "tap ";
        return result;
    };
    EXPECT_EQ(story_of(400'000, 0.f), "tap double ");
    EXPECT_EQ(story_of(400'001, 0.f), "tap tap ");
    EXPECT_EQ(story_of(200'000, 19.9f), "tap double ");
    EXPECT_EQ(story_of(200'000, 20.1f), "tap tap ");
    EXPECT_EQ(story_of(81'000, 0.f), "tap double ");
    EXPECT_EQ(story_of(80'000, 0.f), "tap ") << "a drop-out";
}

TEST_F(GesturesTest, TapsOnTwoThingsAreNoDoubleTap) {
    tap(1, {199.f, 400.f});
    frames(2);
    tap(1, {201.f, 400.f});
    frames(3);
    EXPECT_EQ(story(), "tap, tap");
}

TEST_F(GesturesTest, TwoFingersAtOnceAreTwoTapsOfTwo) {
    down(1, background);
    down(2, background + Vector2f(18.f, 0.f));
    frames(3);
    up(1);
    up(2);
    frames(4);
    ASSERT_EQ(story(), "tap, tap");
    for (const Gesture& gesture : all_) EXPECT_EQ(gesture.fingers, 2);
}

TEST_F(GesturesTest, HoldIsToldAtItsTimeWithoutAnEvent) {
    down(1, on_two);
    wait(599'999);
    EXPECT_EQ(story(), "");
    wait(1);
    EXPECT_EQ(story(), "hold");
    EXPECT_EQ(last().target, 2);
    wait(1'000'000);
    up(1);
    wait(100'000);
    EXPECT_EQ(story(), "hold") << "once, and no tap after it";
}

TEST_F(GesturesTest, UpJustBeforeAHoldIsATap) {
    down(1, background);
    now_us_ += 599'999;
    up(1);
    wait(500'000);
    EXPECT_EQ(story(), "tap");
}

TEST_F(GesturesTest, AHeldFingerCanStillDrag) {
    down(1, background);
    frames(20);
    move_to(1, background + Vector2f(100.f, 0.f), 20);
    frames(5);
    up(1);
    frames(4);
    EXPECT_EQ(story(), "hold, drag begin, drag end");
    EXPECT_EQ(every<Drag>().back().total_px, Vector2f(50.f, 0.f));
}

TEST_F(GesturesTest, DragBeginsOutsideTheTapRadiusOnly) {
    down(1, background);
    frames(5);
    put(1, background + Vector2f(0.f, 7.9f));
    frames(5);
    EXPECT_EQ(story(), "");
    put(1, background + Vector2f(0.f, 8.1f));
    frames(2);
    ASSERT_EQ(story(), "drag begin");
    EXPECT_NEAR(every<Drag>()[0].total_px.y(), 4.05f, 1e-4f);
    EXPECT_EQ(every<Drag>()[0].delta_px, every<Drag>()[0].total_px) << "stays under the finger";
}

TEST_F(GesturesTest, OneFrameOutsideIsJitterUnlessFarOutside) {
    down(1, background);
    frames(5);
    put(1, background + Vector2f(12.f, 0.f));
    frame();
    put(1, background);
    frames(2);
    EXPECT_EQ(story(), "");
    put(1, background + Vector2f(16.1f, 0.f));
    frame();
    EXPECT_EQ(story(), "drag begin");
}

TEST_F(GesturesTest, ARestingFingerTellsNoChanges) {
    down(1, background);
    move_to(1, background + Vector2f(50.f, 0.f), 5);
    const std::size_t told = all_.size();
    frames(5);
    EXPECT_EQ(all_.size(), told);
}

TEST_F(GesturesTest, SlowDragIsNoSwipe) {
    down(1, background);
    move_to(1, background + Vector2f(100.f, 0.f), 15);  // 202 mm/s
    up(1);
    frames(4);
    EXPECT_EQ(story(), "drag begin, drag end");
}

TEST_F(GesturesTest, FastDragEndsWithItsSwipe) {
    down(1, background);
    frame();
    move_to(1, background + Vector2f(0.f, -120.f), 6);  // 606 mm/s
    up(1);
    frames(4);
    ASSERT_EQ(story(), "drag begin, drag end, swipe");
    const Swipe swipe = every<Swipe>()[0];
    EXPECT_NEAR(swipe.velocity_px_s.x(), 0.f, 0.1f);
    EXPECT_NEAR(swipe.velocity_px_s.y(), -120.f / 6.f / mm_per_px / 0.033f, 0.5f);
    EXPECT_EQ(swipe.total_px, Vector2f(0.f, -60.f));
    EXPECT_EQ(swipe.place_px, background / mm_per_px + Vector2f(0.f, -60.f));
}

TEST_F(GesturesTest, SwipeBeginsAtItsSpeedAndLength) {
    const auto swipes = [&](float speed_mm_s, float length_mm) {
        all_.clear();
        down(1, background);
        frame();
        const float step_mm = speed_mm_s * 0.033f;
        const int count = static_cast<int>(std::ceil(length_mm / step_mm));
        put(1, background + Vector2f(length_mm - static_cast<float>(count) * step_mm, 0.f));
        move_to(1, background + Vector2f(length_mm, 0.f), count);
        up(1);
        frames(4);
        return every<Swipe>().size();
    };
    EXPECT_EQ(swipes(310.f, 60.f), 1U);
    EXPECT_EQ(swipes(290.f, 60.f), 0U);
    EXPECT_EQ(swipes(600.f, 30.5f), 1U);
    EXPECT_EQ(swipes(600.f, 29.5f), 0U);
}

TEST_F(GesturesTest, AFingerThatStopsBeforeItLiftsDoesNotSwipe) {
    down(1, background);
    move_to(1, background + Vector2f(150.f, 0.f), 6);
    frames(5);
    up(1);
    frames(4);
    EXPECT_EQ(story(), "drag begin, drag end");
}

TEST_F(GesturesTest, AFingerUnseenForLongBeforeItLiftsDoesNotSwipe) {
    down(1, background);
    move_to(1, background + Vector2f(150.f, 0.f), 6);
    now_us_ += 200'000;
    up(1);
    frames(4);
    EXPECT_EQ(story(), "drag begin, drag end");
}

}  // namespace
}  // namespace touchstone
