#include <gtest/gtest.h>

#include "tests/accuracy/path_score.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

PathScore scored_track(const std::filesystem::path& sequence) {
    const TemporaryFolder folder;
    const std::string path = (folder / "path.txt").string();
    const test::ProgramResult result = test::run_program(
        {TOUCHSTONE_PROGRAM, "track", "--sensor", "seq:" + sequence.string(), "--trajectory", path});
    EXPECT_EQ(result.status, 0) << result.err;
    return score_path(read_trajectory(path), read_true_path(sequence));
}

// Bar: 24 mm, no frame lost; measured 22 mm.
TEST(ScoredTrack, KitchenMeetsItsBar) {
    const std::filesystem::path sequence = std::string(TOUCHSTONE_SHARED_DIR) + "/data/redkitchen-000-299";
    if (!exists(sequence)) GTEST_SKIP() << sequence << " is not there";
    const PathScore score = scored_track(sequence);
    EXPECT_EQ(score.matched, 300U);
    EXPECT_LT(score.ate_rmse_mm, 24.0);
}

// The bar of 25 mm is not met: 36 to 40 mm measured. No frame may be lost, and it must not become worse.
TEST(ScoredTrack, DeskIsNeverLost) {
    const std::filesystem::path sequence = std::string(TOUCHSTONE_SHARED_DIR) + "/data/tum-fr1-rpy-000-119";
    if (!exists(sequence)) GTEST_SKIP() << sequence << " is not there";
    const PathScore score = scored_track(sequence);
    EXPECT_EQ(score.matched, 120U);
    EXPECT_LT(score.ate_rmse_mm, 45.0);
}

}  // namespace
}  // namespace touchstone
