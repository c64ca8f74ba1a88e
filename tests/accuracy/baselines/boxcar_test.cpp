#include "tests/accuracy/baselines/boxcar.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

int kept(const Mask& mask) {
    return static_cast<int>(std::count(mask.values.begin(), mask.values.end(), set_value));
}

TEST(Boxcar, KeepsWhereEnoughOfTheSquareIsSet) {
    Mask mask(20, 20);
    fill(mask, {8, 8, 3, 3}, set_value);
    // 9 of 49 pixels are an average of 46.8 at the middle.
    EXPECT_EQ(kept(boxcar(mask, 7, 46)), 25) << "all nine are in the squares of 5 x 5 pixels";
    EXPECT_EQ(kept(boxcar(mask, 7, 47)), 0);
    EXPECT_EQ(boxcar(mask, 7, 46).at(7, 7), set_value);
    EXPECT_EQ(boxcar(mask, 7, 46).at(6, 9), 0);
}

TEST(Boxcar, OutsideThePictureNothingIsSet) {
    Mask mask(20, 20, set_value);
    const Mask smooth = boxcar(mask, 7, 100);
    EXPECT_EQ(smooth.at(0, 0), 0) << "16 of 49 pixels are an average of 83";
    EXPECT_EQ(smooth.at(10, 0), set_value) << "28 of 49";
}

TEST(Boxcar, TheBoundItselfIsNotAboveIt) {
    EXPECT_EQ(kept(boxcar(Mask(20, 20, set_value), 7, 255)), 0);
    EXPECT_EQ(boxcar(Mask(20, 20, set_value), 7, 254).at(10, 10), set_value);
}

TEST(Boxcar, ASideOfOneChangesNothing) {
    Mask mask(9, 5);
    mask.at(8, 4) = set_value;
    EXPECT_EQ(boxcar(mask, 1, 127).values, mask.values);
}

}  // namespace
}  // namespace touchstone::baselines
