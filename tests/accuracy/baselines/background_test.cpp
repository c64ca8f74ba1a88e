#include "tests/accuracy/baselines/background.hpp"

#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

TEST(Background, MeanAndSpreadLeaveOutMissingReadings) {
    Readings readings;
    for (const int mm : {998, 0, 1002}) readings.add(DepthPicture(1, 1, static_cast<std::uint16_t>(mm)));
    const Background background = readings.statistics();
    EXPECT_FLOAT_EQ(background.mean_mm.at(0, 0), 1000.0F);
    EXPECT_FLOAT_EQ(background.sd_mm.at(0, 0), 2.0F);
    EXPECT_FLOAT_EQ(readings.largest().mean_mm.at(0, 0), 1002.0F);
    EXPECT_EQ(readings.frames(), 3);
}

TEST(Background, NeverReadIsNoBackground) {
    Readings readings;
    readings.add(DepthPicture(1, 1, 0));
    EXPECT_EQ(readings.statistics().mean_mm.at(0, 0), 0.0F);
    EXPECT_LT(height_mm(readings.statistics(), DepthPicture(1, 1, 900), 0), -10000.0F);
    EXPECT_LT(height_mm(background_of(DepthPicture(1, 1, 900)), DepthPicture(1, 1, 0), 0), -10000.0F);
}

TEST(Background, HeightIsTowardsTheCamera) {
    const Background background = background_of(level_picture());
    const DepthPicture picture = with_block(level_picture(), {3, 2, 1, 1}, 12);
    EXPECT_FLOAT_EQ(height_mm(background, picture, picture.index(3, 2)), 12.0F);
}

}  // namespace
}  // namespace touchstone::baselines
