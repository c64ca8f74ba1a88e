#include "tests/accuracy/baselines/world_kit.hpp"

#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

/// Whether blocks over the learnt surface are a touch; without spread, relative heights are millimetres.
bool touches(const DepthPicture& picture) {
    WorldKit method({});
    show_surface(method);
    return !method.process(picture).empty();
}

TEST(WorldKit, ACoreMakesATouchFromSixToThirtyMillimetres) {
    for (const int mm : {0, 3, 5, 6, 20, 30, 31, 50})
        EXPECT_EQ(touches(with_block(level_picture(), {20, 10, 5, 5}, mm)), mm >= 6 && mm <= 30) << mm;
}

TEST(WorldKit, ATouchHasFivePixelsOfCoreAndTenInAll) {
    const DepthPicture low = with_block(level_picture(), {20, 10, 6, 1}, 4);
    EXPECT_TRUE(touches(with_block(low, {20, 11, 5, 1}, 10)));
    EXPECT_FALSE(touches(with_block(low, {20, 11, 4, 1}, 10))) << "four pixels of core";
    EXPECT_FALSE(touches(with_block(level_picture(), {20, 11, 9, 1}, 10))) << "nine pixels in all";
    EXPECT_FALSE(touches(with_block(low, {20, 12, 5, 1}, 10))) << "the core is apart from the rest";
}

TEST(WorldKit, HeightIsRelativeToTheSpread) {
    WorldKit method({});
    for (int i = 0; i < 100; ++i)
        method.process(DepthPicture(64, 48, static_cast<std::uint16_t>(i % 2 == 0 ? 998 : 1002)));
    EXPECT_TRUE(method.process(with_block(level_picture(), {20, 10, 5, 5}, 17)).empty()) << "6 x (2 + 1) mm";
    EXPECT_FALSE(method.process(with_block(level_picture(), {20, 10, 5, 5}, 18)).empty());
}

}  // namespace
}  // namespace touchstone::baselines
