#include "tests/accuracy/scored_run.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace touchstone {
namespace {

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Twenty seconds of two hands on a flat table, the short form of the scored runs (score_tables prints the
/// long one). The bars are those of the product: 95 % of contacts of two frames or more, under 3 spurious
/// touches a minute, 5 mm.
TEST(ScoredRun, FlatTableMeetsItsBars) {
    const TouchScore score = scored_run(TOUCHSTONE_PROGRAM, "flat", 101, 600);
    std::printf("%s\n", line_of(score).c_str());
    ASSERT_GT(score.of_two_and_more.contacts, 10);
    EXPECT_GE(score.of_two_and_more.rate(), 0.95);
    EXPECT_LT(score.spurious_ids / score.minutes(), 3.0);
    EXPECT_LT(mean(score.position_mm), 5.0);
}

}  // namespace
}  // namespace touchstone
