#include "tests/accuracy/mask_run.hpp"

#include <gtest/gtest.h>

#include "platform/system/percentile.hpp"
#include "tests/accuracy/mask_picture.hpp"

namespace touchstone {
namespace {

TEST(MaskFrame, CountsAsItSays) {
    const MaskFrame frame{"", 100, 80, 60, 1000};
    EXPECT_DOUBLE_EQ(frame.iou(), 0.5);
    EXPECT_DOUBLE_EQ(frame.marked_share(), 0.08);
    EXPECT_DOUBLE_EQ(MaskFrame{}.iou(), 1.0);
}

/// Agreed, missed, too many, not counted, nothing.
TEST(MaskPicture, ColoursSayWhatIsWrong) {
    const Image16 depth{5, 1, {1000, 1000, 1000, 1000, 0}};
    const std::vector<std::uint8_t> truth{255, 255, 0, 255, 0}, mask{255, 0, 255, 0, 0},
        counted{255, 255, 255, 0, 255};
    const Image8 picture = mask_picture(depth, truth, mask, counted);
    const std::vector<std::uint8_t> expected{35, 255, 35, 35, 35, 255, 255, 35, 35, 70, 70, 70, 0, 0, 0};
    EXPECT_EQ(picture.pixels, expected);
}

/// The short form of score_segmentation: eleven seconds of two hands on a flat table, the product's bars.
TEST(ScoredMasks, FlatTableMeetsItsBars) {
    const MaskScore score = scored_simulation(TOUCHSTONE_PROGRAM, "flat", 101, 330);
    std::printf("%s\n", line_of(score).c_str());
    ASSERT_GT(score.overlap.size(), 50u);
    ASSERT_FALSE(score.false_area.empty());
    EXPECT_GT(percentile(score.overlap, 50.0), 0.90);
    EXPECT_GT(percentile(score.overlap, 10.0), 0.80);
    EXPECT_LT(percentile(score.false_area, 100.0), 0.001);
    EXPECT_EQ(score.missing, 0);
}

}  // namespace
}  // namespace touchstone
