#include "tests/accuracy/object_run.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

/// The bars in a short form.
TEST(ObjectRun, PutDownAndTakenThreeTimesLeavesNothing) {
    const Device device(DeviceConfig{});
    const PutAndTakeScore score = run_put_and_take(device, "flat", 1, 3);
    EXPECT_EQ(score.settled, 3);
    EXPECT_EQ(score.taken, 3);
    EXPECT_EQ(score.lifted, 0);
    EXPECT_EQ(score.ghost_vertices, 0);
}

TEST(ObjectRun, ABoxLiftedOutOfTheScanIsCutOut) {
    const Device device(DeviceConfig{});
    const LiftScore score = run_lift(device, "flat", 1, "box");
    ASSERT_TRUE(score.lifted);
    EXPECT_EQ(score.cuts, 1);
    EXPECT_LT(score.after_s, 1.0);
    EXPECT_GT(score.iou, 0.85);
}

TEST(ObjectRun, AHandIsNotInTheScan) {
    const Device device(DeviceConfig{});
    const MoverScore score = run_scan_with_mover(device, "flat", 1, 1);
    EXPECT_GT(score.live_after_frames, 0);
    EXPECT_LT(score.wrong_share, 0.005);
}

}  // namespace
}  // namespace touchstone
