#include "tests/accuracy/baselines/dynamic_background.hpp"

#include <gtest/gtest.h>

namespace touchstone::baselines {
namespace {

/// Depth that jumps by `spread_mm` to both sides.
void show(DynamicBackground& background, int mm, int spread_mm, int frames) {
    for (int i = 0; i < frames; ++i)
        background.add(
            DepthPicture(1, 1, static_cast<std::uint16_t>(i % 2 == 0 ? mm - spread_mm : mm + spread_mm)));
}

float mean_mm(const DynamicBackground& background) { return background.get().mean_mm.at(0, 0); }

TEST(DynamicBackground, AStablePixelIsLearntAfterThirtyReadings) {
    DynamicBackground background({});
    show(background, 2000, 3, 29);
    EXPECT_EQ(mean_mm(background), 0.0F);
    show(background, 2000, 3, 71);
    EXPECT_NEAR(mean_mm(background), 2000.0F, 0.1F);
    EXPECT_NEAR(background.get().sd_mm.at(0, 0), 3.0F, 0.1F);
}

TEST(DynamicBackground, ASpreadOfOneMillimetreAtOneMetreIsTooMuch) {
    DynamicBackground at_one_metre({}), at_two_metres({});
    show(at_one_metre, 1000, 2, 100);
    show(at_two_metres, 2000, 2, 100);
    EXPECT_EQ(mean_mm(at_one_metre), 0.0F);
    EXPECT_GT(mean_mm(at_two_metres), 0.0F) << "4 mm are allowed there";
}

TEST(DynamicBackground, WhatIsNearerNeverBecomesBackground) {
    DynamicBackground background({});
    show(background, 2000, 3, 100);
    show(background, 1980, 3, 300);
    EXPECT_NEAR(mean_mm(background), 2000.0F, 0.5F);
    show(background, 1996, 3, 300);
    EXPECT_NEAR(mean_mm(background), 1996.0F, 0.5F) << "a drift of less than 5 mm is followed";
}

TEST(DynamicBackground, WhatIsFartherEndsIt) {
    DynamicBackground background({});
    show(background, 2000, 1, 100);
    show(background, 2050, 1, 1);
    EXPECT_EQ(mean_mm(background), 0.0F);
    show(background, 2050, 1, 100);
    EXPECT_NEAR(mean_mm(background), 2050.0F, 0.5F);
}

}  // namespace
}  // namespace touchstone::baselines
