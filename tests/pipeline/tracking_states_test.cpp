// When a pose is good, poor or lost, and that the reason is said.
#include <gtest/gtest.h>
#include <random>

#include "pipeline/camera_tracking.hpp"
#include "tests/support/oriented_scene.hpp"

namespace touchstone {
namespace {

using test::moved;

TrackingResult judged(float inlier_share, float model_share, float close_share) {
    TrackingResult result;
    result.inlier_share = inlier_share;
    result.model_share = model_share;
    result.close_share = close_share;
    result.rms_mm = 7.0f;
    judge_tracking({}, result);
    return result;
}

TEST(TrackingStates, FollowInliersModelAndCloseness) {
    EXPECT_EQ(judged(0.9f, 0.9f, 0.8f).state, TrackingState::good);
    EXPECT_EQ(judged(0.9f, 0.9f, 0.8f).reason, "");
    struct Case {
        float inlier_share, model_share, close_share;
        TrackingState state;
        const char* reason;
    };
    for (const Case& c : {Case{0.51f, 0.9f, 0.8f, TrackingState::good, ""},
                          {0.49f, 0.9f, 0.8f, TrackingState::poor, "49 % of the view fits the scan"},
                          {0.26f, 0.9f, 0.8f, TrackingState::poor, "26 % of the view fits the scan"},
                          {0.24f, 0.9f, 0.8f, TrackingState::lost, "only 24 % of the view fits the scan"},
                          {0.9f, 0.11f, 0.8f, TrackingState::good, ""},
                          {0.9f, 0.09f, 0.8f, TrackingState::lost, "only 9 % of the view has been scanned"},
                          {0.9f, 0.9f, 0.21f, TrackingState::good, ""},
                          {0.9f, 0.9f, 0.19f, TrackingState::poor, "the view is 7 mm off the scan"},
                          {0.9f, 0.9f, 0.11f, TrackingState::poor, "the view is 7 mm off the scan"},
                          {0.9f, 0.9f, 0.09f, TrackingState::lost, "the view is 7 mm off the scan"}}) {
        const TrackingResult result = judged(c.inlier_share, c.model_share, c.close_share);
        EXPECT_EQ(result.state, c.state) << c.reason;
        EXPECT_EQ(result.reason, c.reason);
    }
}

TEST(TrackingStates, AStepThatIsTooLargeIsLost) {
    const CameraTrackingConfig config;  // 150 mm, 12 degrees
    const auto state_after = [&](const RigidTransform& step) {
        TrackingResult result = judged(0.9f, 0.9f, 0.8f);
        judge_step(config, step, result);
        EXPECT_EQ(result.reason.empty(), result.state == TrackingState::good);
        return result.state;
    };
    EXPECT_EQ(state_after(RigidTransform::Identity()), TrackingState::good);
    EXPECT_EQ(state_after(moved({0.0f, 149.0f, 0.0f})), TrackingState::good);
    EXPECT_EQ(state_after(moved({0.0f, 151.0f, 0.0f})), TrackingState::lost);
    EXPECT_EQ(state_after(moved({0.0f, 0.0f, 0.0f}, 11.9f)), TrackingState::good);
    EXPECT_EQ(state_after(moved({0.0f, 0.0f, 0.0f}, -12.1f)), TrackingState::lost);
    TrackingResult poor = judged(0.4f, 0.9f, 0.8f);
    judge_step(config, RigidTransform::Identity(), poor);
    EXPECT_EQ(poor.state, TrackingState::poor);
    EXPECT_FALSE(poor.reason.empty());
}

class TrackedStates : public testing::Test {
  protected:
    TrackingResult track(const reference::OrientedPicture& live, const reference::OrientedPicture& model) {
        test::write_live(live, live_);
        test::write_model(model, prediction_);
        const std::array guesses{RigidTransform::Identity()};
        return tracking_.track(live_, prediction_, guesses);
    }

    const Device device_{DeviceConfig{}};
    const Intrinsics k_ = test::small_camera(160, 120);
    CameraTracking tracking_{device_, {}, k_};
    LiveMaps live_{device_, make_map_shape(k_)};
    SurfacePrediction prediction_{device_, live_.shape};
    const reference::OrientedPicture corner_ = test::view_of(k_, test::corner(), RigidTransform::Identity());
};

/// Balls half a metre before the walls, another size and another place than the model's.
TEST_F(TrackedStates, AnotherSceneIsLost) {
    const auto other = test::view_of(
        k_, test::nearest_of({test::ball({-0.1, 0.0, 0.9}, 0.3), test::ball({0.3, 0.1, 0.7}, 0.12)}),
        RigidTransform::Identity());
    const TrackingResult result = track(other, corner_);
    EXPECT_EQ(result.state, TrackingState::lost);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_TRUE(result.T_p_c.matrix().allFinite());
}

TEST_F(TrackedStates, NoPictureAndNoModelAreLost) {
    auto nothing = corner_;
    test::make_holes(nothing, [](int, int) { return true; });
    for (const auto& [live, model] : {std::pair{nothing, corner_}, {corner_, nothing}, {nothing, nothing}}) {
        const TrackingResult result = track(live, model);
        EXPECT_EQ(result.state, TrackingState::lost);
        EXPECT_FALSE(result.reason.empty());
        EXPECT_EQ(result.held_directions, 6);
        EXPECT_TRUE(result.T_p_c.isApprox(RigidTransform::Identity(), 0.0f));
    }
}

/// Of the pixels that have a model, 60 % show a thing 0.4 m before it.
TEST_F(TrackedStates, WhatIsMostlyCoveredIsPoor) {
    auto live = corner_;
    for (std::size_t i = 0; i < live.depth_m.size(); ++i) {
        if (i % 160 < 96) live.depth_m[i] = std::max(0.3f, live.depth_m[i] - 0.4f);
    }
    const TrackingResult result = track(live, corner_);
    EXPECT_EQ(result.state, TrackingState::poor);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_NEAR(result.inlier_share, 0.4f, 0.02f);
    EXPECT_LT(test::pose_error(result.T_p_c, RigidTransform::Identity()).mm, 0.5f);
}

/// Twelve times the noise that the sensor is said to have: the share within 2 sigma falls from 0.99 to about
/// that of a normal distribution, 2 Phi(2 / 12) - 1 = 0.13 (0.21 was measured, as far pairs pull less), while
/// the residual's root mean square in sigmas is bounded by Tukey's weight.
TEST_F(TrackedStates, ClosenessFallsWithTheNoise) {
    auto live = corner_;
    std::mt19937 random(2);
    std::normal_distribution<float> gauss;
    for (float& z : live.depth_m) z += 12.0f * 0.0018f * gauss(random);
    EXPECT_GT(track(corner_, corner_).close_share, 0.98f);
    const TrackingResult result = track(live, corner_);
    EXPECT_GT(result.close_share, 0.1f);
    EXPECT_LT(result.close_share, 0.25f);
    EXPECT_LT(result.rms_sigmas, 2.0f);
    CameraTrackingConfig strict;
    strict.poor_close_share = 0.3f;
    TrackingResult judged_strictly = result;
    judge_tracking(strict, judged_strictly);
    EXPECT_EQ(judged_strictly.state, TrackingState::poor);
}

/// A fifth of the view has a model: shares are of what can be compared, and of what is measured.
TEST_F(TrackedStates, SharesAreOfTheirOwnPixels) {
    auto model = corner_;
    test::make_holes(model, [](int x, int) { return x % 5 != 0; });
    const TrackingResult result = track(corner_, model);
    EXPECT_NEAR(result.model_share, 0.2f, 0.02f);
    EXPECT_GT(result.inlier_share, 0.95f);
    EXPECT_EQ(result.state, TrackingState::good) << result.reason;
}

}  // namespace
}  // namespace touchstone
