#include "pipeline/touch_bias.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// A slanted table a metre away.
const Vector3f normal_c = Vector3f(0.1f, -0.5f, -1.0f).normalized();
const Vector3f right_c = Vector3f(1.0f, 0.0f, 0.1f).normalized();
const Vector3f down_c = normal_c.cross(right_c);

/// A finger that leans by 40 degrees, its hand at this angle around the tip.
TouchPlace touch_from(float side_deg, const Vector3f& place_c_m) {
    const float side = side_deg * 0.0174533f;
    const Vector3f flat = std::cos(side) * right_c + std::sin(side) * down_c;
    return {place_c_m, normal_c, (0.77f * flat + 0.64f * normal_c).normalized()};
}

/// As a camera with a bias would see touches of crosses 15 cm apart, from these sides, with noise.
std::vector<CrossTouch> touches(const TouchBias& bias, const std::vector<float>& sides_deg, float noise_m) {
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0.0f, noise_m);
    std::vector<CrossTouch> result;
    for (int cross = 0; cross < 4; ++cross) {
        const Vector3f true_c_m = Vector3f(-0.2f, 0.0f, 1.0f) + 0.15f * static_cast<float>(cross) * right_c;
        for (const float side_deg : sides_deg) {
            TouchPlace place = touch_from(side_deg, true_c_m);
            place.surface_c_m = corrected(place, {-bias.along_m, -bias.across_m}) + noise(random) * right_c +
                                noise(random) * down_c;
            result.push_back({cross, place});
        }
    }
    return result;
}

TEST(TouchBias, AMeasuredPlaceMovesAlongTheSurfaceOnly) {
    const TouchPlace place = touch_from(30.0f, {0.0f, 0.0f, 1.0f});
    const Vector3f step = corrected(place, {0.004f, -0.001f}) - place.surface_c_m;
    EXPECT_NEAR(step.dot(normal_c), 0.0f, 1e-6f);
    EXPECT_NEAR(step.norm(), std::hypot(0.004f, 0.001f), 1e-6f);
    EXPECT_GT(step.dot(place.axis_c), 0.002f);
}

TEST(TouchBias, AnUprightFingerHasNoDirection) {
    EXPECT_EQ(corrected({{0.0f, 0.0f, 1.0f}, normal_c, normal_c}, {0.004f, 0.004f}),
              Vector3f(0.0f, 0.0f, 1.0f));
}

/// Noise of 1.5 mm a coordinate, 12 touches: known to 0.5 mm; within three of that.
TEST(TouchBias, IsFoundFromTouchesOfCrossesWhosePlaceNobodyKnows) {
    const TouchBias truth{0.0042f, -0.0017f};
    const TouchBiasFit fit = fit_touch_bias(touches(truth, {0.0f, 100.0f, 200.0f}, 0.0015f), {});
    EXPECT_EQ(fit.verdict, BiasVerdict::good);
    EXPECT_NEAR(fit.bias.along_m, truth.along_m, 0.0015f);
    EXPECT_NEAR(fit.bias.across_m, truth.across_m, 0.0015f);
    EXPECT_GT(fit.sigma_m, 0.0002f);
    EXPECT_LT(fit.sigma_m, 0.0008f);
    EXPECT_LT(fit.rms_m, 0.7f * fit.rms_before_m);
}

TEST(TouchBias, WithoutNoiseItIsExact) {
    const TouchBiasFit fit = fit_touch_bias(touches({0.003f, 0.001f}, {0.0f, 90.0f}, 0.0f), {});
    EXPECT_EQ(fit.verdict, BiasVerdict::good);
    EXPECT_NEAR(fit.bias.along_m, 0.003f, 1e-5f);
    EXPECT_NEAR(fit.bias.across_m, 0.001f, 1e-5f);
    EXPECT_LT(fit.rms_m, 1e-5f);
}

TEST(TouchBias, FromOneSideNothingIsTold) {
    const TouchBiasFit fit = fit_touch_bias(touches({0.004f, 0.0f}, {80.0f, 90.0f, 100.0f}, 0.001f), {});
    EXPECT_EQ(fit.verdict, BiasVerdict::one_sided);
    EXPECT_EQ(fit.bias.along_m, 0.0f);
}

TEST(TouchBias, TooFewAndScatteredTouchesAreSaid) {
    EXPECT_EQ(fit_touch_bias({}, {}).verdict, BiasVerdict::too_few);
    EXPECT_EQ(fit_touch_bias(touches({}, {0.0f}, 0.001f), {}).verdict, BiasVerdict::too_few);
    EXPECT_EQ(fit_touch_bias(touches({}, {0.0f, 120.0f, 240.0f}, 0.012f), {}).verdict,
              BiasVerdict::scattered);
}

}  // namespace
}  // namespace touchstone
