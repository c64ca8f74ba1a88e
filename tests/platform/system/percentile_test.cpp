#include "platform/system/percentile.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(Percentile, InterpolatesBetweenTheNearestRanks) {
    EXPECT_DOUBLE_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 50.0), 2.5);
    EXPECT_DOUBLE_EQ(percentile({10.0, 20.0, 30.0}, 95.0), 29.0);
    EXPECT_DOUBLE_EQ(percentile({10.0, 20.0, 30.0}, 0.0), 10.0);
    EXPECT_DOUBLE_EQ(percentile({10.0, 20.0, 30.0}, 100.0), 30.0);
}

TEST(Percentile, TakesOneValueOrNone) {
    EXPECT_DOUBLE_EQ(percentile({7.0}, 99.0), 7.0);
    EXPECT_DOUBLE_EQ(percentile({}, 50.0), 0.0);
}

}  // namespace
}  // namespace touchstone
