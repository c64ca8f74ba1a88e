#include "tests/accuracy/baselines/finger_slices.hpp"

#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

TEST(FingerSlices, AStripOfFivePixelsIsAFinger) {
    const auto chains = find_slice_chains(with_block(level_picture(), {20, 10, 5, 20}, 15), {});
    ASSERT_EQ(chains.size(), 1U);
    EXPECT_EQ(chains.front().size(), 20U);
    EXPECT_EQ(chains.front().front(), Eigen::Vector2d(22.0, 10.0));
    EXPECT_EQ(chains.front().back(), Eigen::Vector2d(22.0, 29.0));
}

TEST(FingerSlices, ALyingStripIsFoundByItsColumns) {
    const auto chains = find_slice_chains(with_block(level_picture(), {20, 10, 20, 5}, 15), {});
    ASSERT_EQ(chains.size(), 1U);
    EXPECT_EQ(chains.front().front(), Eigen::Vector2d(20.0, 12.0));
}

TEST(FingerSlices, WidthLengthAndHeightHaveLimits) {
    const auto count = [](const Block& block, int height_mm) {
        return find_slice_chains(with_block(level_picture(), block, height_mm), {}).size();
    };
    EXPECT_EQ(count({20, 10, 4, 20}, 15), 1U);
    EXPECT_EQ(count({20, 10, 3, 20}, 15), 0U);
    EXPECT_EQ(count({20, 10, 6, 20}, 15), 1U);
    EXPECT_EQ(count({20, 10, 7, 20}, 15), 0U);
    EXPECT_EQ(count({20, 10, 5, 8}, 15), 1U);
    EXPECT_EQ(count({20, 10, 5, 7}, 15), 0U);
    EXPECT_EQ(count({20, 10, 5, 20}, 5), 1U);
    EXPECT_EQ(count({20, 10, 5, 20}, 4), 0U);
    EXPECT_EQ(count({20, 10, 5, 20}, 57), 1U);
    EXPECT_EQ(count({20, 10, 5, 20}, 58), 0U);
}

TEST(FingerSlices, AGapOfTwoLinesIsBridged) {
    for (const int gap_px : {2, 3}) {
        DepthPicture picture = with_block(level_picture(), {20, 10, 5, 6}, 15);
        picture = with_block(picture, {20, 16 + gap_px, 5, 6}, 15);
        EXPECT_EQ(find_slice_chains(picture, {}).size(), gap_px == 2 ? 1U : 0U);
    }
}

}  // namespace
}  // namespace touchstone::baselines
