#include "tests/accuracy/knock_run.hpp"

#include <gtest/gtest.h>

#include "tests/support/analytic_scene.hpp"

namespace touchstone {
namespace {

TEST(PoseErrorTest, SlidingAlongAPlaneIsNoErrorOfTheSurface) {
    const Device device{DeviceConfig{}};
    const Intrinsics k = test::small_camera();
    SurfacePrediction wall(device, make_map_shape(k));
    wall.depth_m.fill(1.0f);
    const RigidTransform still = RigidTransform::Identity();
    RigidTransform aside = still, nearer = still;
    aside.translation().x() = 0.010f;
    nearer.translation().z() = 0.004f;
    const PoseError slid = pose_error(still, aside, wall, k), moved = pose_error(still, nearer, wall, k);
    EXPECT_NEAR(slid.shift_mm, 10.0f, 1e-3f);
    EXPECT_NEAR(slid.surface_mm, 0.0f, 1e-3f);
    EXPECT_NEAR(moved.shift_mm, 4.0f, 1e-3f);
    EXPECT_NEAR(moved.surface_mm, 4.0f, 1e-3f);
    EXPECT_NEAR(pose_error(aside, aside, wall, k).shift_mm, 0.0f, 1e-3f);
}

/// The bar: a knock of 5 degrees or 50 mm is put right within 30 frames, touches frozen meanwhile.
TEST(KnockRunTest, KnockOfFiveDegreesIsPutRightWithinASecond) {
    const Device device{DeviceConfig{}};
    KnockRun run{"mixed", 3, 1, 5.0f, 0.0f, 150, 100};
    const KnockScore score = run_knock(device, run);
    ASSERT_TRUE(score.frames_to_notice.has_value());
    ASSERT_TRUE(score.frames_to_live.has_value());
    EXPECT_LE(*score.frames_to_live, 30);
    EXPECT_EQ(score.frozen_reports, 0);
    EXPECT_EQ(score.open_touches, 0);
    EXPECT_EQ(score.early_downs, 0);
    EXPECT_EQ(score.false_alarms, 0);
    EXPECT_EQ(score.scans_anew, 0);
    EXPECT_LT(score.error.surface_mm, 1.0f);
    EXPECT_LT(score.error.shift_mm, 3.0f);
    EXPECT_LT(score.error.turn_deg, 0.3f);
}

TEST(KnockRunTest, CameraThatStandsStillIsNeverRealigned) {
    const Device device{DeviceConfig{}};
    const KnockScore score = run_knock(device, {"cluttered", 4, 2, 0.0f, 0.0f, 250, 120});
    EXPECT_FALSE(score.frames_to_notice.has_value());
    EXPECT_EQ(score.false_alarms, 0);
    EXPECT_EQ(score.scans_anew, 0);
}

}  // namespace
}  // namespace touchstone
