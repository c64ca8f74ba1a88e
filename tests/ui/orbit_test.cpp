// A camera a metre over a table that is tilted by 30 degrees against its line of sight.
#include "ui/orbit.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float degree = std::numbers::pi_v<float> / 180.f;

class OrbitTest : public testing::Test {
  protected:
    OrbitTest() {
        frame_.intrinsics = {585.f, 585.f, 319.5f, 239.5f, 640, 480, {0, 0}};
        frame_.T_g_c.translation() = Vector3f(0.5f, 0.6f, 0.7f);
        // The far edge is lower: the normal leans back by 30 degrees.
        const Vector3f u(1.f, 0.f, 0.f), v(0.f, std::cos(30.f * degree), -std::sin(30.f * degree));
        frame_.area = {Vector3f(0.f, 0.f, 1.f) - 0.5f * u - 0.5f * v, u, v};
        frame_.has_area = true;
    }
    /// Where a point of the global frame is seen.
    Vector2f seen_px(const Orbit& orbit, const Vector3f& point_g_m) const {
        const Vector3f p = orbit.T_g_v().inverse() * point_g_m;
        const Intrinsics& k = frame_.intrinsics;
        return {k.fx_px * p.x() / p.z() + k.cx_px, k.fy_px * p.y() / p.z() + k.cy_px};
    }
    Vector3f middle_g_m() const { return frame_.T_g_c * Vector3f(0.f, 0.f, 1.f); }
    const Vector2f middle_px_{319.5f, 239.5f};
    TableFrame frame_;
};

TEST_F(OrbitTest, StartsAsTheCameraSeesIt) {
    const Orbit orbit(frame_);
    EXPECT_TRUE(orbit.T_g_v().isApprox(frame_.T_g_c, 1e-5f));
    EXPECT_NEAR(orbit.distance_m(), 1.f, 1e-4f);
    EXPECT_NEAR(orbit.elevation_rad(), 60.f * degree, 1e-3f);
}

TEST_F(OrbitTest, TurningKeepsThePointInTheMiddleAndItsDistance) {
    Orbit orbit(frame_);
    for (int i = 0; i < 40; ++i) orbit.turn({13.f, i % 2 == 0 ? 9.f : -4.f});
    EXPECT_LT((seen_px(orbit, middle_g_m()) - middle_px_).norm(), 0.1f);
    EXPECT_NEAR((orbit.T_g_v().translation() - middle_g_m()).norm(), 1.f, 1e-4f);
}

/// What lies nearer than the middle goes with the finger.
TEST_F(OrbitTest, TheNearSideFollowsTheFinger) {
    Orbit orbit(frame_);
    const Vector3f near_g_m = middle_g_m() + frame_.T_g_c.linear() * (0.2f * frame_.area.axis_v_c_m);
    const Vector2f before = seen_px(orbit, near_g_m);
    EXPECT_GT(before.y(), middle_px_.y());
    orbit.turn({30.f, 0.f});
    EXPECT_GT(seen_px(orbit, near_g_m).x(), before.x() + 5.f);
    EXPECT_NEAR(orbit.elevation_rad(), 60.f * degree, 1e-3f) << "sideways does not tilt";
}

TEST_F(OrbitTest, DownLooksFromAboveUpFromTheSideAndNeverFromBelow) {
    Orbit orbit(frame_);
    orbit.turn({0.f, 20.f});
    EXPECT_GT(orbit.elevation_rad(), 62.f * degree);
    for (int i = 0; i < 100; ++i) orbit.turn({0.f, 20.f});
    EXPECT_NEAR(orbit.elevation_rad(), 1.55f, 0.01f);
    for (int i = 0; i < 100; ++i) orbit.turn({0.f, -20.f});
    EXPECT_NEAR(orbit.elevation_rad(), 0.12f, 0.01f);
    EXPECT_LT((seen_px(orbit, middle_g_m()) - middle_px_).norm(), 0.1f);
}

TEST_F(OrbitTest, MovingTakesTheMiddleAlongWithTheFingers) {
    Orbit orbit(frame_);
    orbit.turn({100.f, -50.f});
    orbit.move({60.f, -35.f});
    EXPECT_LT((seen_px(orbit, middle_g_m()) - middle_px_ - Vector2f(60.f, -35.f)).norm(), 0.2f);
}

/// A point at the middle's distance under the fingers stays under them.
TEST_F(OrbitTest, StretchingAndRollingKeepWhatLiesUnderTheFingers) {
    Orbit orbit(frame_);
    const Vector2f fingers_px(420.f, 180.f);
    const Vector3f under_g_m =
        frame_.T_g_c * Vector3f((420.f - 319.5f) / 585.f, (180.f - 239.5f) / 585.f, 1.f);
    const Vector3f beside_g_m = under_g_m + frame_.T_g_c.linear() * Vector3f(0.05f, 0.f, 0.f);
    const Vector2f before = seen_px(orbit, beside_g_m) - seen_px(orbit, under_g_m);
    Similarity delta;
    delta.center_px = fingers_px;
    delta.translation_px = Vector2f(7.f, -3.f);
    delta.scale = 1.5f;
    delta.rotation_rad = 0.3f;
    orbit.transform(delta);
    EXPECT_LT((seen_px(orbit, under_g_m) - fingers_px - delta.translation_px).norm(), 0.3f);
    const Vector2f after = seen_px(orbit, beside_g_m) - seen_px(orbit, under_g_m);
    const Vector2f expected = 1.5f * (Eigen::Rotation2Df(0.3f) * before);
    EXPECT_LT((after - expected).norm(), 0.5f);
}

TEST_F(OrbitTest, ZoomEndsAtItsLimitsAndResetBringsAllBack) {
    Orbit orbit(frame_);
    Similarity delta;
    delta.center_px = middle_px_;
    delta.scale = 2.f;
    for (int i = 0; i < 10; ++i) orbit.transform(delta);
    EXPECT_NEAR(orbit.distance_m(), 0.25f, 1e-4f);
    delta.scale = 0.5f;
    for (int i = 0; i < 10; ++i) orbit.transform(delta);
    EXPECT_NEAR(orbit.distance_m(), 3.f, 1e-4f);
    orbit.reset();
    EXPECT_TRUE(orbit.T_g_v().isApprox(frame_.T_g_c, 1e-5f));
}

}  // namespace
}  // namespace touchstone
