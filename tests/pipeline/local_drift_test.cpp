#include "pipeline/local_drift.hpp"

#include <gtest/gtest.h>

#include "tests/support/finger_scene.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

class LocalDrift : public testing::Test {
  protected:
    float drift_after_lifting(float height_m) {
        for (float& z : scene.live_m) z -= height_m;
        scene.finish();
        scene.padded_mask = mask;
        return local_drift_m(scene.picture(), {Vector3f(0.0f, 0.0f, 1.0f), Vector3f(0.0f, 0.0f, -1.0f), true},
                             {});
    }
    test::FingerScene scene{test::plane_ground({0.0f, 0.0f, 1.0f}, 1.0f)};
    std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(map_pixels(make_map_shape(scene.k)), 0);
};

TEST_F(LocalDrift, IsTheHeightTheBackgroundSeemsToHave) {
    EXPECT_NEAR(drift_after_lifting(0.006f), 0.006f, 1e-4f);
}

TEST_F(LocalDrift, LeavesTheForegroundOut) {
    const MapShape shape = make_map_shape(scene.k);
    for (int y = 0; y < scene.k.height_px; ++y) {
        for (int x = 0; x < 119; ++x) {
            mask[map_index(shape, x, y)] = 255;
            scene.live_m[scene.background.index(x, y)] -= 0.05f;
        }
    }
    EXPECT_NEAR(drift_after_lifting(0.003f), 0.003f, 1e-4f);
}

TEST_F(LocalDrift, IsNothingWhereNoBackgroundIsSeen) {
    std::ranges::fill(mask, std::uint8_t{255});
    EXPECT_EQ(drift_after_lifting(0.006f), 0.0f);
}

TEST_F(LocalDrift, AStepOfTheSurfaceIsNoDrift) { EXPECT_EQ(drift_after_lifting(0.03f), 0.0f); }

}  // namespace
}  // namespace touchstone
