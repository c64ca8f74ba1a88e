#include <cmath>
#include <random>

#include "gestures_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

TEST_F(GesturesTest, QuickTapsBesideEachOtherAreOfOneFingerEach) {
    tap(1, background);
    tap(2, background + Vector2f(60.f, 0.f));
    frames(4);
    ASSERT_EQ(story(), "tap, tap");
    for (const Gesture& gesture : all_) EXPECT_EQ(gesture.fingers, 1);
    EXPECT_NE(all_[0].group, all_[1].group);
}

TEST_F(GesturesTest, DropOutOfARestingFingerIsNeitherTapNorNewHold) {
    down(1, background);
    frames(5);
    for (int i = 0; i < 3; ++i) {
        up(1);
        frames(2);
        down(1, background + Vector2f(3.f, -3.f));
        frames(4);
    }
    EXPECT_EQ(story(), "hold");
    up(1);
    frames(4);
    EXPECT_EQ(story(), "hold");
}

TEST_F(GesturesTest, DropOutsAreBridgedUpToTheirTimeAndRadius) {
    const auto after = [&](std::uint64_t gap_us, float apart_mm) {
        all_.clear();
        down(1, background);
        frames(2);
        up(1);
        now_us_ += gap_us;
        down(1, background + Vector2f(apart_mm, 0.f));
        frames(4);
        const std::string result = story();
        take(recognizer_.cancel());
        return result;
    };
    EXPECT_EQ(after(80'000, 0.f), "");
    EXPECT_EQ(after(80'001, 0.f), "tap");
    EXPECT_EQ(after(60'000, 14.9f), "drag begin") << "the same finger, outside its tap radius";
    EXPECT_EQ(after(60'000, 15.1f), "tap") << "another finger; the first was a tap";
}

TEST_F(GesturesTest, DragGoesOnOverADropOutAlongItsWay) {
    down(1, background);
    move_to(1, background + Vector2f(160.f, 0.f), 8);  // 606 mm/s
    up(1);
    frames(2);
    down(1, background + Vector2f(220.f, 2.f));  // 40 mm on
    frame();
    EXPECT_EQ(story(), "drag begin");
    move_to(1, background + Vector2f(300.f, 0.f), 4);
    up(1);
    frames(4);
    EXPECT_EQ(story(), "drag begin, drag end, swipe");
    EXPECT_EQ(every<Drag>().back().total_px, Vector2f(150.f, 0.f));
}

TEST_F(GesturesTest, TransformGoesOnWithTheOtherFingerWhileOneDropsOut) {
    down(1, on_one);
    down(2, on_one + Vector2f(0.f, 100.f));
    const auto both_at = [&](float x_mm) {
        put(1, on_one + Vector2f(x_mm, 0.f));
        put(2, on_one + Vector2f(x_mm, 100.f));
    };
    for (const float x_mm : {5.f, 10.f, 15.f, 20.f, 25.f}) {
        both_at(x_mm);
        frame();
    }
    up(2);
    both_at(30.f);
    frame();
    both_at(35.f);
    frame();
    down(2, on_one + Vector2f(40.f, 100.f));
    both_at(40.f);
    frame();
    EXPECT_EQ(story(), "transform begin");
    Vector2f moved_px(0.f, 0.f);
    for (const Transform& transform : every<Transform>()) {
        moved_px += transform.delta.translation_px;
        EXPECT_NEAR(transform.delta.scale, 1.f, 1e-4f);
        EXPECT_NEAR(transform.delta.rotation_rad, 0.f, 1e-4f);
    }
    EXPECT_NEAR((moved_px - Vector2f(20.f, 0.f)).norm(), 0.f, 1e-3f);
}

TEST_F(GesturesTest, AHiddenFingerDoesNotAnchorATransform) {
    down(1, on_one);
    down(2, on_one + Vector2f(0.f, 100.f));
    frame();
    down_[2] = false;  // told by hand below
    for (int i = 1; i <= 5; ++i) {
        put(1, on_one + Vector2f(6.f * static_cast<float>(i), 0.f));
        touch(2, TouchPhase::move, FingerState::hidden);
        frame();
    }
    ASSERT_EQ(story(), "transform begin");
    EXPECT_EQ(last().fingers, 2);
    for (const Transform& transform : every<Transform>()) EXPECT_EQ(transform.delta.rotation_rad, 0.f);
}

TEST_F(GesturesTest, IdSwitchWithinAFrameInEitherOrder) {
    for (const bool down_first : {true, false}) {
        down(1, background);
        move_to(1, background + Vector2f(60.f, 0.f), 6);
        const std::string before = story();
        const int old_id = ids_[1];
        TouchEvent lift;
        lift.phase = TouchPhase::up;
        lift.tip.id = old_id;
        lift.tip.pixel_px = places_mm_[1] / mm_per_px;
        if (!down_first) recognizer_.on_touch(lift, now_us_);
        down(1, background + Vector2f(70.f, 0.f));
        if (down_first) recognizer_.on_touch(lift, now_us_);
        frames(5);
        EXPECT_EQ(story(), before);
        take(recognizer_.cancel());
        all_.clear();
    }
}

TEST_F(GesturesTest, ANewFingerWhereOneHasJustLeftIsNoTransform) {
    down(1, on_one);
    move_to(1, on_one + Vector2f(100.f, 0.f), 6);
    up(1);
    frame();
    down(1, on_one + Vector2f(0.f, 100.f));
    frame();
    EXPECT_EQ(story(), "drag begin, drag end, swipe") << "at once: a thing has one group of fingers";
    up(1);
    frames(4);
    EXPECT_EQ(story(), "drag begin, drag end, swipe, tap");
}

TEST_F(GesturesTest, EventsOfUnknownFingersAreIgnored) {
    ids_[7] = 99;
    places_mm_[7] = background;
    touch(7, TouchPhase::up);
    touch(7, TouchPhase::move);
    touch(7, TouchPhase::up);
    frames(30);
    EXPECT_EQ(story(), "");
}

TEST_F(GesturesTest, CancelEndsWhatIsOpenAndNothingComesAfter) {
    down(1, on_one);
    down(2, on_two);
    down(3, on_two + Vector2f(0.f, 50.f));
    down(4, background);
    for (int i = 1; i <= 5; ++i) {
        put(1, on_one + Vector2f(0.f, 20.f * static_cast<float>(i)));
        put(2, on_two + Vector2f(20.f * static_cast<float>(i), 0.f));
        frame();
    }
    const std::size_t before = all_.size();
    up(1);
    take(recognizer_.cancel());
    EXPECT_EQ(story(before), "drag end cancelled, transform end cancelled");
    for (int finger = 2; finger <= 4; ++finger) up(finger);
    frames(30);
    take(recognizer_.cancel());
    EXPECT_EQ(all_.size(), before + 2);
}

TEST_F(GesturesTest, CancelForgetsTheFirstTap) {
    tap(1, background);
    frames(3);
    take(recognizer_.cancel());
    tap(1, background);
    frames(3);
    EXPECT_EQ(story(), "tap, tap");
}

TEST_F(GesturesTest, FingersLeftFromBeforeACancelAreIgnoredUntilTheyComeDown) {
    down(1, background);
    frames(3);
    take(recognizer_.cancel());
    move_to(1, background + Vector2f(100.f, 0.f), 10);
    EXPECT_EQ(story(), "");
}

TEST_F(GesturesTest, EarlierTimesCountAsTheLast) {
    down(1, background);
    frames(10);
    now_us_ = 5;
    frame();
    up(1);
    now_us_ = 1'000'000 + 11 * frame_us;
    frames(4);
    EXPECT_EQ(story(), "tap");
}

/// Jitter of 2 mm standard deviation in each direction, drop-outs of one or two frames in every tenth frame.
class NoisyGesturesTest : public GesturesTest {
  protected:
    Vector2f jitter_mm() { return {jitter_(random_), jitter_(random_)}; }
    std::mt19937 random_{3};
    std::normal_distribution<float> jitter_{0.f, 2.f};
};

TEST_F(NoisyGesturesTest, TapsAndHoldsAreNotTornIntoDrags) {
    for (int i = 0; i < 200; ++i) {
        const bool hold = i % 2 == 1;
        const Vector2f at_mm = i % 4 < 2 ? background : on_two;
        down(1, at_mm + jitter_mm());
        for (int k = 0; k < (hold ? 25 : 5); ++k) {
            put(1, at_mm + jitter_mm());
            frame();
        }
        up(1);
        frames(20);
    }
    int drags = 0;
    for (const Drag& drag : every<Drag>()) drags += drag.phase == GesturePhase::begin ? 1 : 0;
    EXPECT_GE(every<Tap>().size() + every<DoubleTap>().size(), 98U) << "of 100";
    EXPECT_GE(every<Hold>().size(), 97U) << "of 100";
    EXPECT_LE(drags, 4) << "of 200, 3000 frames";
}

TEST_F(NoisyGesturesTest, ADragWithDropOutsIsOneDragAndFollowsTheFinger) {
    down(1, background);
    std::bernoulli_distribution drops_out(0.1);
    for (int k = 1; k <= 300; ++k) {
        const float angle = 0.02f * static_cast<float>(k);
        const Vector2f at_mm =
            background + 80.f * Vector2f(std::cos(angle) - 1.f, std::sin(angle)) + jitter_mm();
        if (!down_[1]) {
            down(1, at_mm);
        } else if (drops_out(random_)) {
            up(1);
        }
        put(1, at_mm);
        frame();
    }
    EXPECT_EQ(story(), "drag begin");
}

TEST_F(NoisyGesturesTest, TheSameEventsGiveTheSameGestures) {
    const auto run = [](std::uint64_t step_us) {
        GestureRecognizer recognizer(config(), two_things);
        std::mt19937 random(9);
        std::uniform_real_distribution<float> place(0.f, 500.f);
        std::vector<Gesture> result;
        for (std::uint64_t t = 0; t < 200; ++t) {
            TouchEvent event;
            event.tip.id = static_cast<int>(random() % 4);
            event.tip.pixel_px = {place(random), place(random)};
            event.phase = static_cast<TouchPhase>(random() % 3);
            recognizer.on_touch(event, 40'000 * t);
            if (t * 40'000 % step_us == 0)
                for (Gesture& gesture : recognizer.update(40'000 * t)) result.push_back(std::move(gesture));
        }
        for (Gesture& gesture : recognizer.update(200 * 40'000)) result.push_back(std::move(gesture));
        return result;
    };
    const auto a = run(40'000), b = run(160'000);
    ASSERT_EQ(a.size(), b.size()) << "how often it is asked changes nothing";
    EXPECT_GT(a.size(), 50U);
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].what.index(), b[i].what.index());
        EXPECT_EQ(a[i].group, b[i].group);
        EXPECT_EQ(a[i].fingers, b[i].fingers);
    }
}

}  // namespace
}  // namespace touchstone
