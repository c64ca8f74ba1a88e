#include "tests/accuracy/baselines/direct_depth.hpp"

#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

/// An arm from the left, a hand, and a finger that points right; `shadow` hides the surface around the
/// finger.
DepthPicture arm_picture(bool shadow) {
    DepthPicture picture = level_picture();
    if (shadow) fill(picture, {26, 12, 24, 22}, std::uint16_t{0});
    picture = with_block(picture, {0, 16, 20, 14}, 80);
    picture = with_block(picture, {19, 20, 8, 6}, 35);
    return with_block(picture, {27, 20, 12, 6}, 9);
}

TEST(DirectDepth, ATipAtTheSurfaceTouchesAtOnce) {
    DirectDepth method({});
    show_surface(method);
    const auto touches = method.process(arm_picture(false));
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_EQ(touches.front().pixel_px.x(), 38.0);
}

TEST(DirectDepth, TheSmoothedHeightComesDownByHalves) {
    DirectDepth method({});
    show_surface(method);
    EXPECT_TRUE(method.process(arm_picture(true)).empty()) << "9 mm over the surface";
    int frames = 1;
    while (frames < 20 && method.process(arm_picture(false)).empty()) ++frames;
    EXPECT_EQ(frames, 5) << "9, 4.5, 2.3, 1.1 and 0.6 mm are no touch";
}

TEST(DirectDepth, ItLetsGoAboveTwoAndAHalfMillimetres) {
    DirectDepth method({});
    show_surface(method);
    method.process(arm_picture(false));
    EXPECT_TRUE(method.process(arm_picture(true)).empty()) << "half of 9 mm";
}

}  // namespace
}  // namespace touchstone::baselines
