#include "pipeline/finger_cover.hpp"

#include <gtest/gtest.h>

#include "tests/support/finger_scene.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// A table one metre below the camera; the finger in question rests on it.
class Cover : public testing::Test {
  protected:
    static FingerShape finger(const Vector3f& at_m) {
        return {at_m - Vector3f(0.0f, 0.0f, 0.0075f), Vector3f(0.3f, 0.7f, -0.6f).normalized(), 0.0075f};
    }
    bool covered(const Vector3f& at_m) {
        scene.finish();
        return is_covered(scene.picture(), finger(at_m), FingerCoverConfig{});
    }

    test::FingerScene scene{test::plane_ground({0.0f, 0.0f, 1.0f}, 1.0f)};
    Vector3f place_m{0.01f, -0.02f, 1.0f};
};

TEST_F(Cover, AnEmptyTableIsInSight) { EXPECT_FALSE(covered(place_m)); }

TEST_F(Cover, AFingerDoesNotCoverItself) {
    scene.add_hand(place_m, {0.0f, 0.0f, -1.0f}, Vector3f(0.3f, 0.7f, -0.6f).normalized(), 0.0075f, 0.0f);
    EXPECT_FALSE(covered(place_m));
}

/// An arm of 60 mm 150 mm above the table hides what is under it, and nothing 60 mm beside it.
TEST_F(Cover, AnArmAboveCoversWhatIsUnderItOnly) {
    scene.add({{-0.2f, -0.017f, 0.85f}, {0.2f, -0.017f, 0.85f}, 0.03f, 0.03f});
    EXPECT_TRUE(covered(place_m));
    EXPECT_FALSE(covered(place_m + Vector3f(0.0f, 0.09f, 0.0f)));
}

TEST_F(Cover, AShadowWithoutDepthCovers) {
    for (int y = 80; y < 95; ++y)
        for (int x = 115; x < 136; ++x) scene.live_m[scene.background.index(x, y)] = 0.0f;
    EXPECT_TRUE(covered(place_m));
    EXPECT_FALSE(covered(place_m + Vector3f(0.0f, 0.05f, 0.0f)));
}

TEST_F(Cover, OutsideThePictureNothingIsInSight) {
    EXPECT_TRUE(covered(place_m + Vector3f(1.0f, 0.0f, 0.0f)));
}

}  // namespace
}  // namespace touchstone
