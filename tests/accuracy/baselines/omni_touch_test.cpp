#include "tests/accuracy/baselines/omni_touch.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

/// A finger that points down in the picture: 20 mm high at its knuckle, its tip so many over the surface.
DepthPicture finger_picture(int tip_mm) {
    DepthPicture picture = with_block(level_picture(), {10, 0, 30, 6}, 60);
    for (int v = 6; v < 26; ++v) picture = with_block(picture, {20, v, 5, 1}, 20 + tip_mm - (v - 6));
    return picture;
}

TEST(OmniTouch, AFloodRunsOutOfATouchingFinger) {
    OmniTouchConfig config;
    config.flood_px = 500;
    for (const int tip_mm : {0, 6, 20}) {
        OmniTouch method(config);
        EXPECT_EQ(method.process(finger_picture(tip_mm)).size(), tip_mm <= 6 ? 1U : 0U) << tip_mm << " mm";
    }
}

TEST(OmniTouch, TheTouchIsAtTheEndThatIsLow) {
    OmniTouchConfig config;
    config.flood_px = 500;
    OmniTouch method(config);
    const auto touches = method.process(finger_picture(2));
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_NEAR(touches.front().pixel_px.x(), 22.0, 1.0);
    EXPECT_GT(touches.front().pixel_px.y(), 18.0);
}

TEST(OmniTouch, AFloodStaysBeforeTheMiddleOfTheFinger) {
    const DepthPicture picture = level_picture();
    const SliceChain chain{{20, 10}, {20, 20}, {20, 30}};
    EXPECT_EQ(flood_px(picture, chain, 13, 100000), 64U * 28U) << "rows 20 to 47";
    EXPECT_EQ(flood_px(picture, chain, 13, 50), 50U);
}

TEST(OmniTouch, ChainsEndAtTheTip) {
    SliceChain chain;
    for (int v = 8; v < 24; ++v) chain.emplace_back(22, v);
    const DepthPicture picture = finger_picture(2);
    EXPECT_EQ(with_tip_last(chain, picture, 8).back().y(), 23.0);
    std::reverse(chain.begin(), chain.end());
    EXPECT_EQ(with_tip_last(chain, picture, 8).back().y(), 23.0);
}

}  // namespace
}  // namespace touchstone::baselines
