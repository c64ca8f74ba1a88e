#include "tests/accuracy/baselines/direct_zones.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

/// The zone of a block so many millimetres over a surface with a spread of 2 mm.
Zone zone_at(int height_mm) {
    Background background = background_of(level_picture());
    std::fill(background.sd_mm.values.begin(), background.sd_mm.values.end(), 2.0F);
    const DepthPicture picture = with_block(level_picture(), {10, 10, 20, 20}, height_mm);
    return find_zones(background, picture, {}).zone.at(20, 20);
}

TEST(DirectZones, AreDividedByHeight) {
    EXPECT_EQ(zone_at(-11), Zone::error);
    EXPECT_EQ(zone_at(-10), Zone::noise);
    EXPECT_EQ(zone_at(1), Zone::noise);
    EXPECT_EQ(zone_at(2), Zone::low) << "0.7 spreads are 1.4 mm";
    EXPECT_EQ(zone_at(11), Zone::low);
    EXPECT_EQ(zone_at(12), Zone::mid);
    EXPECT_EQ(zone_at(59), Zone::mid);
    EXPECT_EQ(zone_at(60), Zone::high);
}

TEST(DirectZones, ALargeStepIsAnEdge) {
    const Background background = background_of(level_picture());
    const auto zones_of = [&](int height_mm) {
        return find_zones(background, with_block(level_picture(), {10, 10, 20, 20}, height_mm), {}).zone;
    };
    EXPECT_EQ(zones_of(40).at(8, 20), Zone::noise);
    EXPECT_EQ(zones_of(60).at(7, 20), Zone::noise);
    EXPECT_EQ(zones_of(60).at(8, 20), Zone::edge) << "two pixels before the block";
    EXPECT_EQ(zones_of(60).at(28, 20), Zone::edge) << "two pixels before its end";
    EXPECT_EQ(zones_of(110).at(7, 20), Zone::edge) << "three pixels before a step of 100 mm";
}

TEST(DirectZones, WithoutAReadingNothingIsKnown) {
    DepthPicture picture = level_picture();
    picture.at(5, 5) = 0;
    EXPECT_EQ(find_zones(background_of(level_picture()), picture, {}).zone.at(5, 5), Zone::unknown);
}

}  // namespace
}  // namespace touchstone::baselines
