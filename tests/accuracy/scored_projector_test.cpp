// Short form of score_projector.
#include <gtest/gtest.h>

#include "tests/accuracy/projector_run.hpp"

namespace touchstone {
namespace {

/// On a ridge: 1.5 pixels RMS in under 20 s of camera frames, and the light falls where it is meant to.
TEST(ScoredProjector, StripesOnARidge) {
    ProjectorRun run;
    run.program = TOUCHSTONE_PROGRAM;
    run.seed = 5;
    run.touch_frames = 300;
    const ProjectorScore score = run_projector(run);
    EXPECT_EQ(score.model, "pinhole") << score.verdict;
    EXPECT_LT(score.rms_px, 1.5);
    EXPECT_LT(score.frames, 600);
    EXPECT_LT(score.mean_mm, 2.0);
    EXPECT_GT(score.touches, 20);
    EXPECT_LT(score.touch_mean_mm, 6.0);
}

/// A hand comes in at the sixth second, puts a book down and goes, in a bright room: its patterns are
/// repeated.
TEST(ScoredProjector, AHandThatComesInCostsTimeAndNothingElse) {
    ProjectorRun run;
    run.program = TOUCHSTONE_PROGRAM;
    run.seed = 6;
    run.touch_frames = 0;
    run.keys = "&object=book&put_s=6&ambient=0.6";
    const ProjectorScore score = run_projector(run);
    EXPECT_LT(score.rms_px, 1.5) << score.verdict;
    EXPECT_GT(score.frames, 300);
    EXPECT_LT(score.frames, 600);
    EXPECT_LT(score.mean_mm, 2.0);
}

}  // namespace
}  // namespace touchstone
