#include "pipeline/fingertip_tracking.hpp"

#include <gtest/gtest.h>
#include <set>

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// A table one metre away that faces the camera, 0.6 x 0.4 m of it interactive.
class Tracking : public testing::Test {
  protected:
    static FingertipCandidate tip(float x_m, float y_m, float height_m) {
        FingertipCandidate candidate;
        candidate.surface_c_m = {x_m, y_m, 1.0f};
        candidate.normal_c = {0.0f, 0.0f, -1.0f};
        candidate.height_m = height_m;
        candidate.shape.center_m = {x_m, y_m, 1.0f - height_m - 0.0075f};
        candidate.shape.axis = Vector3f(0.0f, 0.7f, -0.7f).normalized();
        candidate.shape.radius_m = 0.0075f;
        candidate.points = 60;
        return candidate;
    }
    TrackedTouches frame(const std::vector<FingertipCandidate>& tips, bool is_covered = false) {
        time_us += 33333;
        return tracking.update(tips, area, k, time_us, [=](const FingerShape&) { return is_covered; });
    }
    /// A finger that is down at x = 0. Its id.
    int finger_down() {
        frame({tip(0.0f, 0.0f, 0.01f)});
        return frame({tip(0.0f, 0.0f, 0.0f)}).touches.at(0).tip.id;
    }

    Intrinsics k{575.8f, 575.8f, 319.5f, 239.5f, 640, 480, {0, 0}};
    InteractiveArea area{Vector3f(-0.3f, -0.2f, 1.0f), Vector3f(0.6f, 0.0f, 0.0f),
                         Vector3f(0.0f, 0.4f, 0.0f)};
    FingertipTracking tracking{FingertipTrackingConfig{}};
    std::uint64_t time_us = 1'000'000;
};

TEST_F(Tracking, DownMoveAndUpComeOnceEachInOrder) {
    EXPECT_TRUE(frame({tip(0.0f, 0.0f, 0.04f)}).touches.empty());
    const auto hover = frame({tip(0.0f, 0.0f, 0.02f)});
    ASSERT_EQ(hover.hovers.size(), 1u);
    EXPECT_NEAR(hover.hovers[0].tip.height_m, 0.02f, 1e-6f);
    const auto down = frame({tip(0.0f, 0.0f, 0.0f)});
    ASSERT_EQ(down.touches.size(), 1u);
    EXPECT_EQ(down.touches[0].phase, TouchPhase::down);
    EXPECT_TRUE(down.hovers.empty());
    EXPECT_EQ(down.touches[0].tip.id, hover.hovers[0].tip.id);
    EXPECT_EQ(frame({tip(0.002f, 0.0f, 0.0f)}).touches.at(0).phase, TouchPhase::move);
    const auto up = frame({tip(0.002f, 0.0f, 0.02f)});
    ASSERT_EQ(up.touches.size(), 1u);
    EXPECT_EQ(up.touches[0].phase, TouchPhase::up);
    EXPECT_NEAR(up.touches[0].tip.surface_c_m.x(), 0.002f, 1e-6f);
    const auto after = frame({tip(0.0f, 0.0f, 0.03f)});
    EXPECT_TRUE(after.touches.empty());
    EXPECT_EQ(after.hovers.at(0).tip.id, hover.hovers[0].tip.id);
}

TEST_F(Tracking, ATapOfOneFrameCounts) {
    frame({tip(0.0f, 0.0f, 0.07f)});
    frame({tip(0.0f, 0.0f, 0.03f)});
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.001f)}).touches.at(0).phase, TouchPhase::down);
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.03f)}).touches.at(0).phase, TouchPhase::up);
}

TEST_F(Tracking, ContactEndsHigherThanItBegins) {
    frame({tip(0.0f, 0.0f, 0.02f)});
    EXPECT_TRUE(frame({tip(0.0f, 0.0f, 0.005f)}).touches.empty());
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.003f)}).touches.at(0).phase, TouchPhase::down);
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.005f)}).touches.at(0).phase, TouchPhase::move);
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.007f)}).touches.at(0).phase, TouchPhase::up);
}

/// A height known to 2.2 mm must be 2 mm lower than one known to 1.2 mm to begin a contact, not to keep it.
TEST_F(Tracking, AnUnsureHeightMustBeLowerToBeginAContact) {
    const auto unsure = [](float height_m) {
        FingertipCandidate candidate = tip(0.0f, 0.0f, height_m);
        candidate.height_sigma_m = 0.0022f;
        return candidate;
    };
    frame({unsure(0.02f)});
    EXPECT_TRUE(frame({unsure(0.0022f)}).touches.empty());
    EXPECT_EQ(frame({unsure(0.0018f)}).touches.at(0).phase, TouchPhase::down);
    EXPECT_EQ(frame({unsure(0.006f)}).touches.at(0).phase, TouchPhase::move);
}

/// At 1.5 m sigma_z is 1.85 times that at 1 m; the limits grow to at most 1.6 times.
TEST_F(Tracking, LimitsGrowWithTheNoiseOfDepth) {
    const auto far_tip = [&](float height_m) {
        FingertipCandidate candidate = tip(0.0f, 0.0f, height_m);
        candidate.shape.center_m.z() += 0.5f;
        return candidate;
    };
    frame({far_tip(0.02f)});
    EXPECT_TRUE(frame({far_tip(0.0066f)}).touches.empty());
    EXPECT_EQ(frame({far_tip(0.0062f)}).touches.at(0).phase, TouchPhase::down);
    EXPECT_EQ(frame({far_tip(0.0102f)}).touches.at(0).phase, TouchPhase::move);
    EXPECT_EQ(frame({far_tip(0.0106f)}).touches.at(0).phase, TouchPhase::up);
}

TEST_F(Tracking, ADragOfHalfAMetreASecondKeepsItsId) {
    frame({tip(-0.2f, 0.0f, 0.02f)});
    std::set<int> ids;
    for (int i = 0; i < 20; ++i) {
        const auto out = frame({tip(-0.2f + 0.017f * static_cast<float>(i), 0.0f, 0.0f)});
        for (const TouchEvent& touch : out.touches) {
            EXPECT_NE(touch.phase, TouchPhase::up);
            ids.insert(touch.tip.id);
        }
    }
    EXPECT_EQ(ids.size(), 1u);
}

TEST_F(Tracking, TwoFingersThatCrossKeepTheirIds) {
    std::vector<int> first, second;
    for (int i = 0; i < 20; ++i) {
        const float x = -0.1f + 0.010f * static_cast<float>(i);
        const auto out = frame({tip(x, 0.0f, 0.0f), tip(-x, 0.012f, 0.0f)});
        for (const TouchEvent& touch : out.touches)
            (touch.tip.surface_c_m.y() < 0.006f ? first : second).push_back(touch.tip.id);
    }
    EXPECT_EQ(std::set<int>(first.begin(), first.end()).size(), 1u);
    EXPECT_EQ(std::set<int>(second.begin(), second.end()).size(), 1u);
}

TEST_F(Tracking, AHiddenFingerIsUnknownNotUp) {
    frame({tip(0.0f, 0.0f, 0.01f)});
    const int id = frame({tip(0.0f, 0.0f, 0.0f)}).touches.at(0).tip.id;
    for (int i = 0; i < 2; ++i) EXPECT_EQ(frame({}).touches.at(0).phase, TouchPhase::move);
    const auto back = frame({tip(0.003f, 0.0f, 0.0f)});
    ASSERT_EQ(back.touches.size(), 1u);
    EXPECT_EQ(back.touches[0].phase, TouchPhase::move);
    EXPECT_EQ(back.touches[0].tip.id, id);
}

/// 0.3 s are nine frames.
TEST_F(Tracking, ACoveredFingerIsKeptForItsTimeAndThenLiftedOnce) {
    const int id = finger_down();
    for (int i = 0; i < 9; ++i) {
        const auto out = frame({}, true);
        ASSERT_EQ(out.touches.size(), 1u) << i;
        EXPECT_EQ(out.touches[0].phase, TouchPhase::move);
        EXPECT_EQ(out.touches[0].tip.id, id);
        EXPECT_EQ(out.touches[0].tip.state, FingerState::hidden);
        EXPECT_TRUE(out.touches[0].tip.surface_c_m.isApprox(Vector3f(0.0f, 0.0f, 1.0f)));
    }
    EXPECT_EQ(frame({}, true).touches.at(0).phase, TouchPhase::up);
    EXPECT_TRUE(frame({}, true).touches.empty());
}

TEST_F(Tracking, ACoveredFingerKeepsItsIdWhenItComesBackNear) {
    const int id = finger_down();
    for (int i = 0; i < 7; ++i) frame({}, true);
    const auto back = frame({tip(0.06f, 0.0f, 0.001f)});
    ASSERT_EQ(back.touches.size(), 1u);
    EXPECT_EQ(back.touches[0].phase, TouchPhase::move);
    EXPECT_EQ(back.touches[0].tip.id, id);
    EXPECT_EQ(back.touches[0].tip.state, FingerState::dragging);
}

TEST_F(Tracking, AFingerThatComesBackAboveTheSurfaceWasLifted) {
    const int id = finger_down();
    for (int i = 0; i < 6; ++i) frame({}, true);
    const auto back = frame({tip(0.01f, 0.0f, 0.03f)});
    ASSERT_EQ(back.touches.size(), 1u);
    EXPECT_EQ(back.touches[0].phase, TouchPhase::up);
    EXPECT_EQ(back.touches[0].tip.id, id);
}

TEST_F(Tracking, AnotherFingerFarAwayIsNotTheCoveredOne) {
    const int id = finger_down();
    frame({}, true);
    for (int i = 0; i < 4; ++i) {
        for (const TouchEvent& touch : frame({tip(0.12f, 0.0f, 0.0f)}, true).touches)
            EXPECT_EQ(touch.tip.surface_c_m.x() > 0.06f, touch.tip.id != id);
    }
}

/// Uncovered, its place is empty: it is waited for as long as any finger that was not found.
TEST_F(Tracking, AFingerWhosePlaceIsSeenEmptyAgainGoesUp) {
    finger_down();
    for (int i = 0; i < 4; ++i) frame({}, true);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(frame({}).touches.at(0).phase, TouchPhase::move) << i;
    EXPECT_EQ(frame({}).touches.at(0).phase, TouchPhase::up);
}

TEST_F(Tracking, ACoveredHoverIsForgotten) {
    frame({tip(0.0f, 0.0f, 0.02f)});
    frame({tip(0.0f, 0.0f, 0.02f)});
    for (int i = 0; i < 6; ++i) {
        const auto out = frame({}, true);
        EXPECT_TRUE(out.touches.empty());
        EXPECT_TRUE(out.hovers.empty());
    }
    EXPECT_TRUE(tracking.expected(time_us + 33333).empty());
}

TEST_F(Tracking, AFingerGoesThroughItsStates) {
    frame({tip(0.0f, 0.0f, 0.03f)});
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.03f)}).hovers.at(0).tip.state, FingerState::hover);
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.0f)}).touches.at(0).tip.state, FingerState::down);
    EXPECT_EQ(frame({tip(0.006f, 0.0f, 0.0f)}).touches.at(0).tip.state, FingerState::down);
    EXPECT_EQ(frame({tip(0.010f, 0.0f, 0.0f)}).touches.at(0).tip.state, FingerState::dragging);
    EXPECT_EQ(frame({tip(0.002f, 0.0f, 0.0f)}).touches.at(0).tip.state, FingerState::dragging);
    EXPECT_EQ(frame({}).touches.at(0).tip.state, FingerState::hidden);
    EXPECT_EQ(frame({tip(0.002f, 0.0f, 0.02f)}).touches.at(0).tip.state, FingerState::hover);
    EXPECT_EQ(frame({tip(0.002f, 0.0f, 0.0f)}).touches.at(0).tip.state, FingerState::down);
    for (int i = 0; i < 3; ++i) frame({});
    EXPECT_EQ(frame({}).touches.at(0).tip.state, FingerState::away);
}

TEST_F(Tracking, AFingerThatStaysAwayGoesUpOnce) {
    frame({tip(0.0f, 0.0f, 0.01f)});
    frame({tip(0.0f, 0.0f, 0.0f)});
    int ups = 0;
    for (int i = 0; i < 10; ++i)
        for (const TouchEvent& touch : frame({}).touches) ups += touch.phase == TouchPhase::up;
    EXPECT_EQ(ups, 1);
}

TEST_F(Tracking, WhatWasSeenOnceDoesNotTouch) {
    EXPECT_TRUE(frame({tip(0.0f, 0.0f, 0.0f)}).touches.empty());
    EXPECT_TRUE(frame({tip(0.2f, 0.1f, 0.0f)}).touches.empty());
}

/// 33 mm beside a finger that is down, a tip that falls from 23 mm to the surface between two frames touches
/// in its second frame there; two fingers that land together touch at once, and so does one farther away.
TEST_F(Tracking, BesideATouchATipMustBeLowTwice) {
    frame({tip(0.0f, 0.0f, 0.02f), tip(0.033f, 0.0f, 0.03f), tip(0.2f, 0.0f, 0.03f)});
    frame({tip(0.0f, 0.0f, 0.0f), tip(0.033f, 0.0f, 0.023f), tip(0.2f, 0.0f, 0.023f)});
    const auto first = frame({tip(0.0f, 0.0f, 0.0f), tip(0.033f, 0.0f, 0.0f), tip(0.2f, 0.0f, 0.0f)});
    ASSERT_EQ(first.touches.size(), 2u);
    EXPECT_EQ(first.touches[1].phase, TouchPhase::down);
    EXPECT_NEAR(first.touches[1].tip.surface_c_m.x(), 0.2f, 1e-6f);
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.0f), tip(0.033f, 0.0f, 0.0f)}).touches.at(1).phase, TouchPhase::down);
}

TEST_F(Tracking, FingersThatLandTogetherTouchAtOnce) {
    frame({tip(0.0f, 0.0f, 0.02f), tip(0.033f, 0.0f, 0.02f)});
    EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.0f), tip(0.033f, 0.0f, 0.0f)}).touches.size(), 2u);
}

/// What falls beside a touch and is not measured again never touches: nothing of it is held.
TEST_F(Tracking, BesideATouchNothingIsHeldThatWasLowOnce) {
    frame({tip(0.0f, 0.0f, 0.02f), tip(0.033f, 0.0f, 0.02f)});
    frame({tip(0.0f, 0.0f, 0.0f), tip(0.033f, 0.0f, 0.023f)});
    frame({tip(0.0f, 0.0f, 0.0f), tip(0.033f, 0.0f, 0.001f)});
    for (int i = 0; i < 3; ++i) EXPECT_EQ(frame({tip(0.0f, 0.0f, 0.0f)}).touches.size(), 1u);
}

TEST_F(Tracking, OutsideTheAreaNothingIsReported) {
    for (int i = 0; i < 4; ++i) {
        const auto out = frame({tip(0.4f, 0.0f, 0.0f), tip(0.0f, 0.3f, 0.02f)});
        EXPECT_TRUE(out.touches.empty());
        EXPECT_TRUE(out.hovers.empty());
    }
}

TEST_F(Tracking, PlacesAreGivenInAreaAndPicture) {
    frame({tip(0.14f, -0.1f, 0.02f)});
    const auto out = frame({tip(0.15f, -0.1f, 0.0f)});
    ASSERT_EQ(out.touches.size(), 1u);
    EXPECT_NEAR(out.touches[0].tip.area_uv.x(), 0.75f, 1e-4f);
    EXPECT_NEAR(out.touches[0].tip.area_uv.y(), 0.25f, 1e-4f);
    EXPECT_NEAR(out.touches[0].tip.pixel_px.x(), 319.5f + 0.15f * 575.8f, 0.01f);
}

TEST_F(Tracking, ARadiusIsLearned) {
    for (int i = 0; i < 30; ++i) {
        FingertipCandidate thick = tip(0.0f, 0.0f, 0.02f);
        thick.shape.radius_m = i % 2 == 0 ? 0.0085f : 0.0095f;
        frame({thick});
    }
    const auto known = tracking.expected(time_us + 33333);
    ASSERT_EQ(known.size(), 1u);
    EXPECT_NEAR(known[0].radius.radius_m, 0.009f, 1.5e-4f);
    EXPECT_LT(known[0].radius.sigma_m, 4e-4f);
}

TEST_F(Tracking, AFingerSeenTwiceIsOneFinger) {
    frame({tip(0.0f, 0.0f, 0.02f)});
    std::set<int> ids;
    for (int i = 0; i < 5; ++i)
        for (const TouchEvent& touch : frame({tip(0.0f, 0.0f, 0.0f), tip(0.0f, 0.011f, 0.002f)}).touches)
            ids.insert(touch.tip.id);
    EXPECT_EQ(ids.size(), 1u);
}

TEST_F(Tracking, ReleaseEndsEveryTouchOnce) {
    frame({tip(0.0f, 0.0f, 0.02f), tip(0.1f, 0.0f, 0.02f)});
    frame({tip(0.0f, 0.0f, 0.0f), tip(0.1f, 0.0f, 0.02f)});
    const auto ups = tracking.release_all();
    ASSERT_EQ(ups.size(), 1u);
    EXPECT_EQ(ups[0].phase, TouchPhase::up);
    EXPECT_TRUE(tracking.release_all().empty());
    EXPECT_TRUE(frame({}).touches.empty());
}

}  // namespace
}  // namespace touchstone
