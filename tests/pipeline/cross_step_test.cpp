#include "pipeline/cross_step.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

#include "pipeline/fingertip_tracking.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// A table one metre away that faces the camera; somebody who touches what the step shows, seen by a camera
/// with a bias.
class CrossStepTest : public testing::Test {
  protected:
    /// The finger's hand is at this angle around the tip; 0: to the right.
    FingertipCandidate finger(const Vector3f& true_c_m, float side_deg, float height_m) const {
        const float side = side_deg * 0.0174533f;
        FingertipCandidate tip;
        tip.normal_c = {0.0f, 0.0f, -1.0f};
        tip.shape.axis = Vector3f(0.8f * std::cos(side), 0.8f * std::sin(side), -0.6f);
        tip.surface_c_m =
            corrected({true_c_m, tip.normal_c, tip.shape.axis}, {-bias.along_m, -bias.across_m});
        tip.height_m = height_m;
        tip.shape.radius_m = 0.0075f;
        tip.shape.center_m = tip.surface_c_m + (height_m + tip.shape.radius_m) * tip.normal_c;
        tip.points = 60;
        return tip;
    }
    std::vector<TouchEvent> see(const std::vector<FingertipCandidate>& tips) {
        time_us += 33333;
        const TrackedTouches tracked = tracking.update(tips, area, k, time_us);
        step.take(tracked.touches, area);
        return tracked.touches;
    }
    /// Comes down, stays for some frames, leaves. The places reported meanwhile.
    std::vector<Vector3f> tap(const Vector3f& at_c_m, float side_deg) {
        std::vector<Vector3f> places;
        for (const float height_m : {0.04f, 0.02f, 0.0f, 0.0f, 0.0f, 0.0f, 0.02f, 0.04f}) {
            for (const TouchEvent& event : see({finger(at_c_m, side_deg, height_m)}))
                places.push_back(event.tip.surface_c_m);
        }
        for (int i = 0; i < 6; ++i) (void)see({});
        return places;
    }
    /// Where the step's cross lies on the table.
    Vector3f cross_c_m() const {
        const Vector2f at = step.guide(area, k).pixel_px;
        return {(at.x() - k.cx_px) / k.fx_px, (at.y() - k.cy_px) / k.fy_px, 1.0f};
    }

    TouchBias bias{0.005f, 0.002f};
    Intrinsics k{575.8f, 575.8f, 319.5f, 239.5f, 640, 480, {0, 0}};
    InteractiveArea area{Vector3f(-0.3f, -0.2f, 1.0f), Vector3f(0.6f, 0.0f, 0.0f),
                         Vector3f(0.0f, 0.4f, 0.0f)};
    FingertipTracking tracking{FingertipTrackingConfig{}};
    CrossStep step{CrossStepConfig{}};
    std::uint64_t time_us = 1'000'000;
};

/// The crosses as drawn lie 8 mm beside the marks that are touched: a screen is not a table.
TEST_F(CrossStepTest, TouchesAreAsTheyShouldBeAfterIt) {
    for (int touch = 0; touch < 15; ++touch) {
        ASSERT_FALSE(step.result()) << touch;
        EXPECT_EQ(step.guide(area, k).touched, touch);
        const float side_deg = 20.0f + 110.0f * static_cast<float>(touch / 5);
        (void)tap(cross_c_m() + Vector3f(0.008f, 0.0f, 0.0f), side_deg);
    }
    ASSERT_TRUE(step.result());
    ASSERT_EQ(step.result()->verdict, BiasVerdict::good) << describe(*step.result());
    const Vector3f somewhere(0.11f, -0.07f, 1.0f);
    EXPECT_GT((tap(somewhere, 250.0f).at(0) - somewhere).norm(), 0.005f);
    tracking.set_bias(step.result()->bias);
    EXPECT_LT((tap(somewhere, 250.0f).at(0) - somewhere).norm(), 0.0002f);
}

TEST_F(CrossStepTest, TouchesElsewhereAndStrokesDoNotCount) {
    (void)tap(cross_c_m() + Vector3f(0.08f, 0.0f, 0.0f), 0.0f);
    EXPECT_EQ(step.guide(area, k).touched, 0);
    EXPECT_EQ(step.guide(area, k).words.find("That was not the cross."), 0u);
    for (int i = 0; i < 12; ++i)
        (void)see({finger(cross_c_m() + Vector3f(0.0f, 0.003f * static_cast<float>(i), 0.0f), 0.0f,
                          i < 2 ? 0.02f : 0.0f)});
    for (int i = 0; i < 6; ++i) (void)see({});
    EXPECT_EQ(step.guide(area, k).touched, 0);
    EXPECT_EQ(step.guide(area, k).words.find("That finger moved"), 0u);
}

TEST_F(CrossStepTest, FromOneSideItGoesOnAndSaysSo) {
    for (int touch = 0; touch < 15; ++touch) (void)tap(cross_c_m(), 30.0f);
    EXPECT_FALSE(step.result());
    EXPECT_NE(step.guide(area, k).words.find("much more"), std::string::npos);
    for (int touch = 0; touch < 5; ++touch) (void)tap(cross_c_m(), 200.0f);
    ASSERT_TRUE(step.result());
    EXPECT_EQ(step.result()->verdict, BiasVerdict::good) << describe(*step.result());
    EXPECT_NEAR(step.result()->bias.along_m, bias.along_m, 0.0002f);
}

TEST_F(CrossStepTest, BeginsAgainWithTheReason) {
    step = CrossStep(CrossStepConfig{}, "Once more.");
    EXPECT_EQ(step.guide(area, k).words.find("Once more."), 0u);
    (void)tap(cross_c_m(), 30.0f);
    EXPECT_EQ(step.guide(area, k).words.find("Once more."), std::string::npos);
}

TEST_F(CrossStepTest, WhoNeverTurnsTheHandGetsNoBias) {
    for (int touch = 0; touch < 30; ++touch) (void)tap(cross_c_m(), 30.0f);
    ASSERT_TRUE(step.result());
    EXPECT_EQ(step.result()->verdict, BiasVerdict::one_sided);
}

}  // namespace
}  // namespace touchstone
