#include "tests/accuracy/baselines/blobs.hpp"

#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

TEST(Blobs, PixelsThatMeetAtACornerAreApart) {
    Mask mask(6, 6);
    mask.at(1, 1) = mask.at(2, 2) = set_value;
    EXPECT_EQ(find_blobs(mask, 1).size(), 2U);
    mask.at(2, 1) = set_value;
    EXPECT_EQ(find_blobs(mask, 1).size(), 1U);
}

TEST(Blobs, RowsDoNotRunOnIntoTheNext) {
    Mask mask(6, 6);
    mask.at(5, 1) = mask.at(0, 2) = set_value;
    EXPECT_EQ(find_blobs(mask, 1).size(), 2U);
    mask.at(0, 1) = set_value;
    EXPECT_EQ(find_blobs(mask, 1).size(), 2U) << "neither way";
}

TEST(Blobs, SmallOnesAreLeftOut) {
    Mask mask(12, 6);
    fill(mask, {0, 0, 2, 2}, set_value);
    fill(mask, {5, 1, 5, 1}, set_value);
    const auto blobs = find_blobs(mask, 5);
    ASSERT_EQ(blobs.size(), 1U);
    EXPECT_EQ(blobs.front().size(), 5U);
    EXPECT_EQ(centroid_px(blobs.front(), 12), Eigen::Vector2d(7.0, 1.0));
}

TEST(Blobs, ARingIsOne) {
    Mask mask(9, 9);
    fill(mask, {1, 1, 7, 7}, set_value);
    fill(mask, {2, 2, 5, 5}, std::uint8_t{0});
    EXPECT_EQ(find_blobs(mask, 1).size(), 1U);
}

}  // namespace
}  // namespace touchstone::baselines
