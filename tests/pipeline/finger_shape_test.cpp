#include "pipeline/finger_shape.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// Points on the side of a finger that faces a camera at the origin.
std::vector<Vector3f> visible_points(const FingerShape& shape, const FingerFitConfig& config, float noise_m,
                                     unsigned seed = 5) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> along(-1.0f, 3.0f), around(0.0f, 6.2832f);
    std::normal_distribution<float> normal(0.0f, 1.0f);
    const Vector3f u = shape.axis.unitOrthogonal(), v = shape.axis.cross(u);
    std::vector<Vector3f> points;
    while (points.size() < 250) {
        const float t = along(random), angle = around(random);
        const Vector3f side = std::cos(angle) * u + std::sin(angle) * v;
        const float behind_m = std::max(0.0f, t) * shape.radius_m;
        const Vector3f outward =
            t >= 0.0f ? side : Vector3f((t * shape.axis + std::sqrt(1.0f - t * t) * side));
        const float radius_m = shape.radius_m * (1.0f + config.widening * behind_m / config.length_m);
        const Vector3f p = shape.center_m + behind_m * shape.axis + radius_m * outward;
        if (outward.dot(p) > -0.1f * p.norm()) continue;
        points.push_back(p + noise_m * normal(random) * p.normalized());
    }
    return points;
}

FingerGuess rough_guess(const FingerShape& truth) {
    FingerGuess guess;
    guess.shape.center_m = truth.center_m + Vector3f(0.003f, -0.003f, 0.003f);
    guess.shape.axis = (truth.axis + Vector3f(0.3f, 0.2f, -0.1f)).normalized();
    guess.shape.radius_m = 0.0075f;
    return guess;
}

/// The plane through the camera and the middle of the round end, across the finger.
FingerGuess held_by_outline(const FingerShape& truth) {
    FingerGuess guess = rough_guess(truth);
    guess.outline.plane_normal = truth.center_m.cross(truth.center_m.cross(truth.axis)).normalized();
    guess.outline.sigma_m = 0.001f;
    return guess;
}

const FingerShape slanted{Vector3f(0.05f, -0.03f, 0.99f), Vector3f(-0.5f, 0.3f, -0.8f).normalized(), 0.0083f};

TEST(FingerShape, DistanceIsThatFromTheSkin) {
    const FingerFitConfig config;
    const FingerShape shape{Vector3f(0.0f, 0.0f, 1.0f), Vector3f(1.0f, 0.0f, 0.0f), 0.008f};
    EXPECT_NEAR(distance_m(shape, config, {-0.010f, 0.0f, 1.0f}), 0.002f, 1e-6f);
    EXPECT_NEAR(distance_m(shape, config, {0.0f, 0.0f, 0.991f}), 0.001f, 1e-6f);
    // 10 % wider at the end of the reach.
    EXPECT_NEAR(distance_m(shape, config, {config.length_m, 0.010f, 1.0f}), 0.010f - 0.0088f, 1e-6f);
}

TEST(FingerShape, ExactPointsGiveTheFingerBackWithinAFifthOfAMillimetre) {
    const FingerFitConfig config;
    const FingerFit fit =
        fit_finger(visible_points(slanted, config, 0.0f), held_by_outline(slanted), 0.0018f, config);
    ASSERT_TRUE(fit.ok);
    EXPECT_LT((fit.shape.center_m - slanted.center_m).norm(), 2e-4f);
    EXPECT_NEAR(fit.shape.radius_m, slanted.radius_m, 2e-4f);
    EXPECT_GT(fit.shape.axis.dot(slanted.axis), 0.9998f);
}

TEST(FingerShape, NoiseOfTheSensorCostsLessThanOneAndAHalfMillimetres) {
    const FingerFitConfig config;
    const FingerFit fit =
        fit_finger(visible_points(slanted, config, 0.0018f), held_by_outline(slanted), 0.0018f, config);
    ASSERT_TRUE(fit.ok);
    EXPECT_LT((fit.shape.center_m - slanted.center_m).norm(), 1.5e-3f);
    EXPECT_GT(fit.rms_sigmas, 0.3f);
    EXPECT_LT(fit.rms_sigmas, 1.2f);
}

TEST(FingerShape, OutliersDoNotPullTheFit) {
    const FingerFitConfig config;
    std::vector<Vector3f> points = visible_points(slanted, config, 0.0005f);
    for (std::size_t i = 0; i < points.size(); i += 5) points[i] += Vector3f(0.0f, 0.015f, 0.02f);
    const FingerFit fit = fit_finger(points, held_by_outline(slanted), 0.0018f, config);
    ASSERT_TRUE(fit.ok);
    EXPECT_LT((fit.shape.center_m - slanted.center_m).norm(), 1e-3f);
    EXPECT_LT(fit.inliers, static_cast<int>(points.size()) * 9 / 10);
}

TEST(FingerShape, AKnownRadiusHolds) {
    const FingerFitConfig config;
    FingerGuess guess = held_by_outline(slanted);
    guess.radius = {0.0070f, 1e-5f};
    const FingerFit fit = fit_finger(visible_points(slanted, config, 0.0f), guess, 0.0018f, config);
    EXPECT_NEAR(fit.shape.radius_m, 0.0070f, 1e-4f);
}

TEST(FingerShape, TheOutlineHoldsTheEndOfAShaftWithoutItsTip) {
    const FingerFitConfig config;
    std::vector<Vector3f> points;
    for (const Vector3f& p : visible_points(slanted, config, 0.0f))
        if ((p - slanted.center_m).dot(slanted.axis) > 0.006f) points.push_back(p);
    FingerGuess guess = held_by_outline(slanted);
    guess.outline.sigma_m = 0.0005f;
    const FingerFit held = fit_finger(points, guess, 0.0018f, config);
    EXPECT_LT(std::abs((held.shape.center_m - slanted.center_m).dot(slanted.axis)), 1.5e-3f);
}

/// Without an outline and without points on the round end, the shape can slide along the shaft.
TEST(FingerShape, AShaftWithoutTipAndOutlineDoesNotHoldThePad) {
    const FingerFitConfig config;
    const Vector3f normal(0.0f, 0.0f, -1.0f);
    std::vector<Vector3f> shaft;
    const std::vector<Vector3f> whole = visible_points(slanted, config, 0.0018f);
    for (const Vector3f& p : whole)
        if ((p - slanted.center_m).dot(slanted.axis) > 0.006f) shaft.push_back(p);
    ASSERT_GT(shaft.size(), 100u);
    FingerGuess guess = held_by_outline(slanted);
    EXPECT_LT(pad_sigma_m(fit_finger(shaft, guess, 0.0018f, config), normal), 2e-3f);
    EXPECT_LT(pad_sigma_m(fit_finger(whole, guess, 0.0018f, config), normal), 2e-3f);
    guess.outline = {};
    const FingerFit slid = fit_finger(shaft, guess, 0.0018f, config);
    EXPECT_GE(slid.inliers, 12);
    EXPECT_GT(pad_sigma_m(slid, normal), 5e-3f);
}

/// The scatter of the pad over 200 noisy views, against what the fits say: the weights of Tukey's loss give
/// some of the points away, so that the fits may say more, by a quarter.
TEST(FingerShape, ThePadScattersAsItsSigmaSays) {
    const FingerFitConfig config;
    const Vector3f normal(0.0f, 0.0f, -1.0f);
    FingerGuess guess = held_by_outline(slanted);
    guess.radius = {slanted.radius_m, 1e-4f};
    double sum = 0.0, squares = 0.0, variances = 0.0;
    constexpr int views = 200;
    for (unsigned seed = 1; seed <= views; ++seed) {
        const FingerFit fit =
            fit_finger(visible_points(slanted, config, 0.0018f, seed), guess, 0.0018f, config);
        ASSERT_TRUE(fit.ok);
        const double pad = static_cast<double>(normal.dot(fit.shape.center_m - slanted.center_m)) -
                           static_cast<double>(fit.shape.radius_m - slanted.radius_m);
        sum += pad;
        squares += pad * pad;
        variances += std::pow(static_cast<double>(pad_sigma_m(fit, normal)), 2.0);
    }
    const double scatter = std::sqrt(squares / views - sum * sum / views / views);
    const double said = std::sqrt(variances / views);
    std::printf("scatter %.2f mm, said %.2f mm\n", 1e3 * scatter, 1e3 * said);
    EXPECT_GT(scatter, 0.6 * said);
    EXPECT_LT(scatter, 1.5 * said);
}

TEST(FingerShape, TooFewPointsAreNoFinger) {
    const std::vector<Vector3f> points(5, slanted.center_m - 0.008f * Vector3f::UnitZ());
    EXPECT_FALSE(fit_finger(points, held_by_outline(slanted), 0.0018f, {}).ok);
    EXPECT_FALSE(fit_finger({}, held_by_outline(slanted), 0.0018f, {}).ok);
}

}  // namespace
}  // namespace touchstone
