#include "ui/similarity.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace touchstone {
namespace {

using Eigen::Vector2f;

/// Pixels, and the unit of scale and radians: single precision over places of a few hundred pixels.
constexpr float tolerance = 1e-4f;

const std::vector<Vector2f> hand{{310.f, 200.f}, {350.f, 180.f}, {390.f, 220.f}};

/// Written out, not by the operator under test.
std::vector<Vector2f> moved(const std::vector<Vector2f>& points, const Vector2f& center, const Vector2f& by,
                            float scale, float rotation_rad) {
    std::vector<Vector2f> result;
    for (const Vector2f& p : points) {
        const Vector2f d = p - center;
        const float c = std::cos(rotation_rad), s = std::sin(rotation_rad);
        result.push_back(center + by + scale * Vector2f(c * d.x() - s * d.y(), s * d.x() + c * d.y()));
    }
    return result;
}

Vector2f centroid(const std::vector<Vector2f>& points) {
    Vector2f sum(0.f, 0.f);
    for (const Vector2f& p : points) sum += p;
    return sum / static_cast<float>(points.size());
}

TEST(Similarity, TranslationAlone) {
    const Similarity fit = fit_similarity(hand, moved(hand, {0.f, 0.f}, {12.f, -7.f}, 1.f, 0.f));
    EXPECT_NEAR(fit.translation_px.x(), 12.f, tolerance);
    EXPECT_NEAR(fit.translation_px.y(), -7.f, tolerance);
    EXPECT_NEAR(fit.scale, 1.f, tolerance);
    EXPECT_NEAR(fit.rotation_rad, 0.f, tolerance);
}

TEST(Similarity, ScaleAboutTheCentroid) {
    for (const float scale : {0.25f, 0.9f, 1.1f, 4.f}) {
        const Similarity fit = fit_similarity(hand, moved(hand, centroid(hand), {0.f, 0.f}, scale, 0.f));
        EXPECT_NEAR(fit.scale, scale, tolerance);
        EXPECT_NEAR(fit.rotation_rad, 0.f, tolerance);
        EXPECT_NEAR(fit.translation_px.norm(), 0.f, tolerance);
        EXPECT_NEAR((fit.center_px - Vector2f(350.f, 200.f)).norm(), 0.f, tolerance);
    }
}

TEST(Similarity, RotationIsPositiveFromXToY) {
    for (const float angle_rad : {-3.f, -0.5f, 0.01f, 1.5f, 3.1f}) {
        const Similarity fit = fit_similarity(hand, moved(hand, centroid(hand), {0.f, 0.f}, 1.f, angle_rad));
        EXPECT_NEAR(fit.rotation_rad, angle_rad, tolerance);
        EXPECT_NEAR(fit.scale, 1.f, tolerance);
    }
}

TEST(Similarity, AllAtOnceAndTheOperatorTakesEachFingerThere) {
    for (const std::size_t fingers : {2U, 3U}) {
        const std::vector<Vector2f> from(hand.begin(), hand.begin() + static_cast<std::ptrdiff_t>(fingers));
        const std::vector<Vector2f> to = moved(from, {100.f, 50.f}, {30.f, 9.f}, 1.3f, -0.7f);
        const Similarity fit = fit_similarity(from, to);
        EXPECT_NEAR(fit.scale, 1.3f, tolerance);
        EXPECT_NEAR(fit.rotation_rad, -0.7f, tolerance);
        for (std::size_t i = 0; i < fingers; ++i) EXPECT_NEAR((fit(from[i]) - to[i]).norm(), 0.f, 2e-4f);
    }
}

TEST(Similarity, OfNoisyFingersItIsNearerThanItsNeighbours) {
    std::mt19937 random(5);
    std::normal_distribution<float> noise_px(0.f, 3.f);
    std::vector<Vector2f> to = moved(hand, {0.f, 0.f}, {5.f, 5.f}, 1.f, 0.3f);
    for (Vector2f& p : to) p += Vector2f(noise_px(random), noise_px(random));
    const Similarity fit = fit_similarity(hand, to);
    const auto residual = [&](const Similarity& s) {
        float sum = 0.f;
        for (std::size_t i = 0; i < hand.size(); ++i) sum += (s(hand[i]) - to[i]).squaredNorm();
        return sum;
    };
    for (const float step : {-0.01f, 0.01f}) {
        Similarity turned = fit, shifted = fit;
        turned.rotation_rad += step;
        shifted.translation_px.x() += 10.f * step;
        EXPECT_GT(residual(turned), residual(fit));
        EXPECT_GT(residual(shifted), residual(fit));
    }
}

TEST(Similarity, ThereAndBackIsTheIdentityWithNoiseToo) {
    const std::vector<Vector2f> to{{300.f, 210.f}, {352.f, 171.f}, {402.f, 218.f}};
    const Similarity there = fit_similarity(hand, to), back = fit_similarity(to, hand);
    EXPECT_NEAR(there.scale * back.scale, 1.f, tolerance);
    EXPECT_NEAR(there.rotation_rad + back.rotation_rad, 0.f, tolerance);
}

TEST(Similarity, FewerThanTwoPlacesGiveTheTranslationAlone) {
    EXPECT_EQ(fit_similarity({}, {}).scale, 1.f);
    const std::array<Vector2f, 2> one_place{Vector2f(5.f, 5.f), Vector2f(5.f, 5.f)};
    const std::array<Vector2f, 2> apart{Vector2f(5.f, 5.f), Vector2f(9.f, 5.f)};
    for (const Similarity& fit : {fit_similarity(std::span(one_place).first(1), std::span(apart).last(1)),
                                  fit_similarity(one_place, apart), fit_similarity(apart, one_place)}) {
        EXPECT_EQ(fit.scale, 1.f);
        EXPECT_EQ(fit.rotation_rad, 0.f);
        EXPECT_TRUE(fit.translation_px.allFinite());
    }
    const Similarity one = fit_similarity(std::span(one_place).first(1), std::span(apart).last(1));
    EXPECT_EQ(one.translation_px, Vector2f(4.f, 0.f));
}

}  // namespace
}  // namespace touchstone
