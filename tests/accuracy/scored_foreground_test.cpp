// The bars of the foreground's surface on a short run of a tuning seed.
#include <gtest/gtest.h>

#include "tests/accuracy/foreground_score.hpp"

namespace touchstone {
namespace {

TEST(ScoredForeground, AMovingArmIsTwiceAsSmoothAsMeasuredAndDoesNotLag) {
    const ForegroundScore score = score_foreground({"cluttered", 1, 150});
    const ForegroundScore::Errors& arms = score.moving_arms;
    ASSERT_GT(arms.shown.residuals, 1000u);
    EXPECT_GT(arms.raw.noise_mm(), 2.0 * arms.shown.noise_mm());
    EXPECT_LT(arms.shown.mean_mm(), 4.0);
    EXPECT_LT(score.moving_hands.shown.mean_mm(), 4.0);
    ASSERT_GT(score.model_lag.frames(), 20u);
    EXPECT_LT(score.model_lag.lag_frames(), 2.0);
    EXPECT_LT(score.shown_lag.lag_frames(), 2.0);
}

}  // namespace
}  // namespace touchstone
