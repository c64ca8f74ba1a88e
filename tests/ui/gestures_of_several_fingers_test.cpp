#include <cmath>
#include <random>

#include "gestures_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

TEST_F(GesturesTest, TwoFastFingersDoNotSwipe) {
    down(1, background);
    down(2, background + Vector2f(0.f, 50.f));
    for (int i = 1; i <= 6; ++i) {
        put(1, background + Vector2f(25.f * static_cast<float>(i), 0.f));
        put(2, background + Vector2f(25.f * static_cast<float>(i), 50.f));
        frame();
    }
    up(2);
    frame();
    up(1);
    frames(6);
    EXPECT_EQ(story(), "transform begin, transform end");
}

TEST_F(GesturesTest, AFingerThatAnchorsATransformIsNoHold) {
    down(1, background);
    down(2, background + Vector2f(0.f, 50.f));
    move_to(1, background + Vector2f(100.f, 0.f), 30);
    EXPECT_EQ(story(), "transform begin");
}

TEST_F(GesturesTest, TwoFingersPinchAndTurn) {
    const Vector2f middle = background;
    down(1, middle + Vector2f(-40.f, 0.f));
    down(2, middle + Vector2f(40.f, 0.f));
    frames(2);
    EXPECT_EQ(story(), "");
    for (int i = 1; i <= 20; ++i) {
        const float angle = 0.05f * static_cast<float>(i), half_mm = 40.f + 2.f * static_cast<float>(i);
        const Vector2f arm_mm = half_mm * Vector2f(std::cos(angle), std::sin(angle));
        const Vector2f at_mm = middle + Vector2f(0.f, 3.f * static_cast<float>(i));
        put(1, at_mm - arm_mm);
        put(2, at_mm + arm_mm);
        frame();
    }
    up(1);
    up(2);
    frames(4);
    ASSERT_EQ(story(), "transform begin, transform end") << "no tap, drag or swipe";
    float scale = 1.f, turn_rad = 0.f;
    Vector2f moved_px(0.f, 0.f);
    for (const Transform& transform : every<Transform>()) {
        scale *= transform.delta.scale;
        turn_rad += transform.delta.rotation_rad;
        moved_px += transform.delta.translation_px;
    }
    EXPECT_NEAR(scale, 2.f, 1e-3f);
    EXPECT_NEAR(turn_rad, 1.f, 1e-3f);
    EXPECT_NEAR((moved_px - Vector2f(0.f, 30.f)).norm(), 0.f, 1e-2f);
    for (const Gesture& gesture : all_) EXPECT_EQ(gesture.fingers, 2);
    // One change a frame, however many fingers moved in it; each exact.
    EXPECT_LE(every<Transform>().size(), 21U);
    EXPECT_NEAR(every<Transform>()[5].delta.rotation_rad, 0.05f, 1e-4f);
}

TEST_F(GesturesTest, DragBecomesATransformAndADragAgain) {
    down(1, on_one);
    move_to(1, on_one + Vector2f(40.f, 0.f), 4);
    down(2, on_one + Vector2f(40.f, 80.f));
    frame();
    EXPECT_EQ(story(), "drag begin, drag end, transform begin");
    move_to(2, on_one + Vector2f(40.f, 120.f), 4);
    EXPECT_NEAR(every<Transform>().back().delta.scale, 120.f / 110.f, 1e-4f);
    up(2);
    frames(4);
    EXPECT_EQ(story(), "drag begin, drag end, transform begin, transform end, drag begin");
    EXPECT_EQ(every<Drag>().back().total_px, Vector2f(0.f, 0.f));
    move_to(1, on_one, 10);
    EXPECT_NEAR((every<Drag>().back().total_px - Vector2f(-20.f, 0.f)).norm(), 0.f, 1e-3f);
    for (const Gesture& gesture : all_) EXPECT_EQ(gesture.group, all_[0].group);
}

TEST_F(GesturesTest, AJoiningFingerDoesNotTurnWhatTheFirstMovesInThatFrame) {
    down(1, on_one);
    move_to(1, on_one + Vector2f(40.f, 0.f), 4);
    down(2, on_one + Vector2f(40.f, 60.f));
    put(1, on_one + Vector2f(50.f, 0.f));
    frame();
    for (const Transform& transform : every<Transform>()) {
        EXPECT_EQ(transform.delta.scale, 1.f);
        EXPECT_EQ(transform.delta.rotation_rad, 0.f);
    }
}

TEST_F(GesturesTest, ThreeFingersAreToldByTheirCount) {
    const Vector2f corners[] = {{-30.f, 0.f}, {0.f, 40.f}, {30.f, 0.f}};
    for (int i = 0; i < 3; ++i) down(i, background + corners[i]);
    frames(2);
    for (int step = 1; step <= 10; ++step) {
        for (int i = 0; i < 3; ++i)
            put(i, background + corners[i] + Vector2f(4.f * static_cast<float>(step), 0.f));
        frame();
    }
    ASSERT_EQ(story(), "transform begin");
    EXPECT_EQ(last().fingers, 3);
    EXPECT_NEAR(every<Transform>().back().delta.translation_px.x(), 2.f, 1e-4f);
    EXPECT_NEAR(every<Transform>().back().delta.scale, 1.f, 1e-5f);
    up(1);
    frames(4);
    EXPECT_EQ(story(), "transform begin, transform end, transform begin");
    EXPECT_EQ(last().fingers, 2);
}

TEST_F(GesturesTest, ThreeNoisyFingersDoNotShrinkWhatTheyHold) {
    std::mt19937 random(11);
    std::normal_distribution<float> jitter_mm(0.f, 2.f);
    const Vector2f corners[] = {{-30.f, 0.f}, {0.f, 40.f}, {30.f, 0.f}};
    for (int i = 0; i < 3; ++i) down(i, background + corners[i]);
    frame();
    for (int step = 0; step < 900; ++step) {
        for (int i = 0; i < 3; ++i)
            put(i, background + Vector2f(40.f, 0.f) + corners[i] +
                       Vector2f(jitter_mm(random), jitter_mm(random)));
        frame();
    }
    float scale = 1.f;
    for (const Transform& transform : every<Transform>()) scale *= transform.delta.scale;
    EXPECT_NEAR(scale, 1.f, 0.15f) << "the jitter of the last frame alone";
}

TEST_F(GesturesTest, TwoPeopleOnTwoThingsAreApart) {
    down(1, on_one);
    down(2, on_two);
    down(3, on_two + Vector2f(0.f, 60.f));
    for (int i = 1; i <= 10; ++i) {
        put(1, on_one + Vector2f(0.f, 5.f * static_cast<float>(i)));
        put(3, on_two + Vector2f(0.f, 60.f + 6.f * static_cast<float>(i)));
        frame();
    }
    for (const Gesture& gesture : all_)
        EXPECT_EQ(gesture.target, std::holds_alternative<Drag>(gesture.what) ? 1 : 2);
    float scale = 1.f;
    for (const Transform& transform : every<Transform>()) scale *= transform.delta.scale;
    EXPECT_NEAR(scale, 2.f, 1e-3f);
    EXPECT_NEAR(every<Drag>().back().total_px.y(), 25.f, 1e-3f);
}

TEST_F(GesturesTest, FingersOnOneThingAreOneGestureHoweverFarApart) {
    down(1, {20.f, 0.f});
    down(2, {20.f, 900.f});
    move_to(1, {100.f, 0.f}, 5);
    EXPECT_EQ(story(), "transform begin");
}

TEST_F(GesturesTest, AThingKeepsFingersThatLeaveIt) {
    down(1, on_one);
    move_to(1, background, 20);
    EXPECT_EQ(last().target, 1);
}

TEST_F(GesturesTest, OnTheBackgroundOnlyFingersOfOneHandJoin) {
    for (const float apart_mm : {229.f, 231.f}) {
        all_.clear();
        down(1, {300.f, 100.f});
        down(2, {300.f, 100.f + apart_mm});
        move_to(1, {340.f, 100.f}, 5);
        EXPECT_EQ(story(), apart_mm < 230.f ? "transform begin" : "drag begin") << apart_mm;
        take(recognizer_.cancel());
    }
}

TEST_F(GesturesTest, TwoHandsOnTheBackgroundAreTwoGroups) {
    down(1, {300.f, 100.f});
    down(2, {300.f, 600.f});
    down(3, {300.f, 650.f});
    for (int i = 1; i <= 8; ++i) {
        put(1, {300.f + 6.f * static_cast<float>(i), 100.f});
        put(2, {300.f + 6.f * static_cast<float>(i), 600.f});
        put(3, {300.f + 6.f * static_cast<float>(i), 650.f});
        frame();
    }
    std::map<int, int> fingers_of_group;
    for (const Gesture& gesture : all_) fingers_of_group[gesture.group] = gesture.fingers;
    ASSERT_EQ(fingers_of_group.size(), 2U);
    EXPECT_EQ(fingers_of_group.begin()->second, 1);
    EXPECT_EQ(fingers_of_group.rbegin()->second, 2);
}

}  // namespace
}  // namespace touchstone
