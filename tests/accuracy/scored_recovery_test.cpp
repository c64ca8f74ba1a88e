// Short form of score_recovery.
#include <gtest/gtest.h>

#include "tests/accuracy/recovery_run.hpp"

namespace touchstone {
namespace {

TEST(ScoredRecovery, LivesThroughRandomFaults) {
    RecoveryRun run;
    run.program = TOUCHSTONE_PROGRAM;
    run.faults = 10;
    run.seed = 3;
    const RecoveryScore score = run_recovery(run);
    EXPECT_GE(score.faults, 10);
    EXPECT_GT(score.downs, 0);
    EXPECT_EQ(score.left_touches, 0);
    EXPECT_EQ(score.confused_events, 0);
    EXPECT_EQ(score.exit_status, 0);
}

TEST(ScoredRecovery, FaultsTouchNothing) {
    RecoveryRun run;
    run.program = TOUCHSTONE_PROGRAM;
    run.faults = 8;
    run.seed = 4;
    run.hands = 0;
    EXPECT_EQ(run_recovery(run).downs, 0);
}

}  // namespace
}  // namespace touchstone
