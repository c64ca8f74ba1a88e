#include "pipeline/hand_motion.hpp"

#include <array>
#include <gtest/gtest.h>
#include <numbers>

namespace touchstone {
namespace {

constexpr std::uint64_t frame_us = 33'333;

Fingertip tip_at(int id, const Eigen::Vector3f& place_m) {
    Fingertip tip;
    tip.id = id;
    tip.surface_c_m = place_m - Eigen::Vector3f(0.0f, 0.0f, -0.02f);
    tip.normal_c = {0.0f, 0.0f, -1.0f};
    tip.height_m = 0.02f;
    return tip;
}

/// The camera's x is the global y.
RigidTransform turned() {
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.linear() = Eigen::AngleAxisf(0.5f * std::numbers::pi_v<float>, Eigen::Vector3f::UnitZ()).matrix();
    return T_g_c;
}

TEST(HandMotion, AMovingFingertipTellsTheSpeedOfItsHand) {
    HandMotion motion;
    for (int i = 0; i < 6; ++i) {
        const float x_m = 0.01f * static_cast<float>(i);  // 0.3 m/s
        const std::array tips{tip_at(1, {x_m, 0.0f, 1.0f})};
        motion.see(tips, turned(), frame_us * static_cast<std::uint64_t>(i + 1));
    }
    const Eigen::Vector3f at_tip = motion.velocity_at({0.0f, 0.05f, 1.0f});
    EXPECT_LT((at_tip - Eigen::Vector3f(0.0f, 0.3f, 0.0f)).norm(), 1e-3f);
    EXPECT_GT(motion.velocity_at({0.1f, 0.1f, 0.95f}).norm(), 0.29f) << "the hand behind it";
    EXPECT_EQ(motion.velocity_at({0.3f, 0.05f, 1.0f}).norm(), 0.0f) << "not what is far from it";
}

/// Jitter of 1 mm at 30 Hz is 30 mm/s from frame to frame.
TEST(HandMotion, AFingerThatOnlyJittersRests) {
    HandMotion motion;
    for (int i = 0; i < 20; ++i) {
        const std::array tips{tip_at(1, {i % 2 == 0 ? 0.001f : -0.001f, 0.0f, 1.0f})};
        motion.see(tips, turned(), frame_us * static_cast<std::uint64_t>(i + 1));
        EXPECT_EQ(motion.velocity_at({0.0f, 0.0f, 1.0f}).norm(), 0.0f);
    }
}

TEST(HandMotion, TheNearestOfTwoHandsCountsAndNoSpeedIsBeyondTheLimit) {
    HandMotion motion;
    for (int i = 0; i < 4; ++i) {
        const float step_m = 0.1f * static_cast<float>(i);  // 3 m/s
        const std::array tips{tip_at(1, {step_m, 0.0f, 1.0f}), tip_at(2, {0.0f, 0.4f, 1.0f})};
        motion.see(tips, RigidTransform::Identity(), frame_us * static_cast<std::uint64_t>(i + 1));
    }
    EXPECT_NEAR(motion.velocity_at({0.3f, 0.0f, 1.0f}).norm(), 1.0f, 1e-3f);
    EXPECT_EQ(motion.velocity_at({0.0f, 0.4f, 1.0f}).norm(), 0.0f);
}

TEST(HandMotion, AFingerThatWentAndCameBackStartsAtRest) {
    HandMotion motion;
    const std::array left{tip_at(1, {0.0f, 0.0f, 1.0f})}, right{tip_at(1, {0.1f, 0.0f, 1.0f})};
    motion.see(left, RigidTransform::Identity(), frame_us);
    motion.see({}, RigidTransform::Identity(), 2 * frame_us);
    motion.see(right, RigidTransform::Identity(), 3 * frame_us);
    EXPECT_EQ(motion.velocity_at({0.1f, 0.0f, 1.0f}).norm(), 0.0f);
}

}  // namespace
}  // namespace touchstone
