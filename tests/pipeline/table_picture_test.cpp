#include "pipeline/table_picture.hpp"

#include <gtest/gtest.h>

#include "tests/support/finger_scene.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

TEST(TablePicture, ProjectionUndoesBackProjection) {
    const Intrinsics k = test::cropped_kinect();
    const Eigen::Vector2f pixel = project(k, back_project(k, 17, 133, 1.3f));
    EXPECT_NEAR(pixel.x(), 17.0f, 1e-3f);
    EXPECT_NEAR(pixel.y(), 133.0f, 1e-3f);
}

TEST(TablePicture, FootPointOnABallIsAlongItsRadius) {
    const Vector3f center(0.02f, 0.0f, 1.2f), outward = Vector3f(0.4f, 0.3f, -1.0f).normalized();
    test::FingerScene scene(test::ball_ground(center, 0.2f));
    scene.finish();
    const SurfacePoint foot = foot_point(scene.picture(), center + 0.23f * outward);
    ASSERT_TRUE(foot.known);
    EXPECT_LT((foot.point_c_m - (center + 0.2f * outward)).norm(), 1e-3f);
}

TEST(TablePicture, NoFootPointOutsideThePictureOrOnUnknownGround) {
    test::FingerScene scene(test::plane_ground({0.0f, 0.0f, 1.0f}, 1.0f));
    scene.finish();
    EXPECT_FALSE(foot_point(scene.picture(), {0.9f, 0.0f, 0.98f}).known);
    EXPECT_FALSE(foot_point(scene.picture(), {0.0f, 0.0f, -1.0f}).known);
    std::ranges::fill(scene.padded_background, 0.0f);
    EXPECT_FALSE(foot_point(scene.picture(), {0.0f, 0.0f, 0.98f}).known);
}

}  // namespace
}  // namespace touchstone
