#include "platform/openni2_drivers/simulator/depth_noise.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace touchstone::sim {
namespace {

constexpr std::size_t pixels = 640 * 480;
constexpr std::size_t middle_row = 240 * 640;
constexpr float focal_px = 575.8F;

/// A wall square to the camera; from column `step_at` on it stands at `near_m`.
std::vector<float> wall(float far_m, std::size_t step_at = 640, float near_m = 0.0F) {
    std::vector<float> depth_m(pixels, far_m);
    for (std::size_t i = 0; i < pixels; ++i)
        if (i % 640 >= step_at) depth_m[i] = near_m;
    return depth_m;
}

struct Statistics {
    double mean_mm = 0.0;
    double temporal_std_mm = 0.0;
    double neighbour_correlation = 0.0;
};

/// Over frames and every 5th valid pixel of some rows.
Statistics measure(float z_m) {
    DepthNoise noise(9, focal_px, true, false);
    std::vector<std::uint16_t> out;
    double sum = 0.0;
    double squares = 0.0;
    double products = 0.0;
    double count = 0.0;
    const double exact = 1000.0 * static_cast<double>(z_m);
    for (int frame = 0; frame < 25; ++frame) {
        noise.apply(wall(z_m), frame, 0.0, out);
        for (std::size_t i = middle_row; i + 8 < middle_row + 640 * 40; i += 5) {
            if (i % 640 > 620 || out[i] == 0 || out[i + 1] == 0) continue;
            const double error = out[i] - exact;
            sum += error;
            squares += error * error;
            products += error * (out[i + 1] - exact);
            count += 1.0;
        }
    }
    const double variance = squares / count - sum * sum / count / count;
    return {sum / count, std::sqrt(variance), (products / count - sum * sum / count / count) / variance};
}

TEST(DepthNoise, OffIsExactToTheRoundedMillimetre) {
    DepthNoise noise(1, focal_px, false, false);
    std::vector<float> depth_m = wall(0.7F);
    for (std::size_t i = 0; i < pixels; ++i) depth_m[i] += 1e-5F * static_cast<float>(i % 6400);
    std::vector<std::uint16_t> out;
    noise.apply(depth_m, 3, 0.1, out);
    for (std::size_t i = 0; i < pixels; i += 11) ASSERT_EQ(out[i], std::lround(1000.0F * depth_m[i]));
}

TEST(DepthNoise, SpreadIsThatOfAKinect) {
    EXPECT_NEAR(measure(1.003F).temporal_std_mm, 1.4, 0.2);
    EXPECT_NEAR(measure(2.007F).temporal_std_mm, 5.3, 0.6);
}

TEST(DepthNoise, MeanIsUnbiased) {
    double sum_mm = 0.0;
    int walls = 0;
    // Each wall sees only two or three steps, and each of them is rounded to a whole millimetre.
    for (float z_m = 0.985F; z_m < 1.015F; z_m += 0.0021F, ++walls) {
        const double mean_mm = measure(z_m).mean_mm;
        EXPECT_NEAR(mean_mm, 0.0, 0.6) << z_m;
        sum_mm += mean_mm;
    }
    EXPECT_NEAR(sum_mm / walls, 0.0, 0.15);
}

TEST(DepthNoise, NeighboursAreCorrelated) { EXPECT_GT(measure(1.0F).neighbour_correlation, 0.3); }

TEST(DepthNoise, ReadingsAreStepsOfAnEighthOfAPixelOfDisparity) {
    DepthNoise noise(2, focal_px, true, false);
    std::vector<std::uint16_t> out;
    noise.apply(wall(1.0F), 0, 0.0, out);
    const std::set<std::uint16_t> values(out.begin(), out.end());
    EXPECT_LE(values.size(), 8U);
    for (const std::uint16_t mm : values) {
        if (mm == 0) continue;
        const double steps = 8.0 * 575.8 * 75.0 / mm;
        EXPECT_NEAR(steps, std::round(steps), 0.2) << mm;  // rounding to 1 mm is 0.17 of a step at 1 m
    }
}

TEST(DepthNoise, TheRightBorderAndWhatIsTooNearHaveNoReading) {
    DepthNoise noise(2, focal_px, true, false);
    std::vector<std::uint16_t> out;
    noise.apply(wall(1.0F), 0, 0.0, out);
    for (std::size_t x = 632; x < 640; ++x) EXPECT_EQ(out[middle_row + x], 0);
    EXPECT_NE(out[middle_row + 631], 0);
    noise.apply(wall(0.35F), 0, 0.0, out);
    EXPECT_EQ(std::count(out.begin(), out.end(), 0), static_cast<long>(pixels));
}

TEST(DepthNoise, TheShadowFallsLeftOfAThingAsWideAsTheDisparityStep) {
    DepthNoise noise(5, focal_px, true, false);
    std::vector<std::uint16_t> out;
    noise.apply(wall(1.2F, 300, 0.8F), 0, 0.0, out);
    // 575.8 px * 75 mm * (1/800 - 1/1200) = 18.0 px; edges jitter by some pixels.
    for (std::size_t x = 286; x < 295; ++x) EXPECT_EQ(out[middle_row + x], 0) << x;
    for (std::size_t x = 250; x < 275; ++x) EXPECT_NEAR(out[middle_row + x], 1200, 12) << x;
    for (std::size_t x = 306; x < 400; ++x) EXPECT_NEAR(out[middle_row + x], 800, 8) << x;
}

TEST(DepthNoise, RightEdgesJitterFromFrameToFrame) {
    DepthNoise noise(5, focal_px, true, false);
    std::vector<float> depth_m = wall(1.2F);
    for (std::size_t i = 0; i < pixels; ++i)
        if (i % 640 > 200 && i % 640 <= 300) depth_m[i] = 0.9F;
    std::vector<std::uint16_t> out;
    std::set<std::size_t> edges;
    for (int frame = 0; frame < 40; ++frame) {
        noise.apply(depth_m, frame, 0.0, out);
        std::size_t x = 290;
        while (out[middle_row + x] < 1000) ++x;
        edges.insert(x);
    }
    EXPECT_GE(edges.size(), 3U);
    EXPECT_GE(*edges.begin(), 296U);
    EXPECT_LE(*edges.rbegin(), 306U);
}

TEST(DepthNoise, GrazingSurfacesLoseMostReadings) {
    DepthNoise noise(6, focal_px, true, false);
    std::vector<float> depth_m(pixels);
    // Disparity that falls linearly along x is a slanted plane: 80 degrees from square in the middle.
    for (std::size_t i = 0; i < pixels; ++i)
        depth_m[i] =
            focal_px * 0.075F / (40.0F - 0.4F * (static_cast<float>(i % 640) - 320.0F) / 1.0F * 0.9F);
    for (float& z : depth_m) z = z < 0.0F || z > 5.0F ? 5.0F : z;
    std::vector<std::uint16_t> out;
    noise.apply(depth_m, 0, 0.0, out);
    int lost = 0;
    for (std::size_t y = 100; y < 200; ++y)
        for (std::size_t x = 310; x < 330; ++x) lost += out[y * 640 + x] == 0;
    EXPECT_GT(lost, 1200);
    EXPECT_LT(lost, 1800);
}

TEST(DepthNoise, SeedAndFrameDecideEverything) {
    DepthNoise one(7, focal_px, true, true);
    DepthNoise same(7, focal_px, true, true);
    DepthNoise other(8, focal_px, true, true);
    std::vector<std::uint16_t> a;
    std::vector<std::uint16_t> b;
    one.apply(wall(1.0F), 5, 0.2, a);
    same.apply(wall(1.0F), 4, 0.1, b);
    EXPECT_NE(a, b);
    same.apply(wall(1.0F), 5, 0.2, b);
    EXPECT_EQ(a, b);
    other.apply(wall(1.0F), 5, 0.2, b);
    EXPECT_NE(a, b);
}

TEST(DepthNoise, WhatIsTooFarForSixteenBitsIsNoReading) {
    DepthNoise noise(3, focal_px, false, false);
    std::vector<std::uint16_t> out;
    noise.apply(wall(70.0F, 300, 60.0F), 0, 0.0, out);
    EXPECT_EQ(out[middle_row + 100], 0);
    EXPECT_EQ(out[middle_row + 400], 60000);
}

TEST(DepthNoise, WhereNothingIsSeenThereIsNoReading) {
    const float nothing_m = std::numeric_limits<float>::infinity();
    for (const bool noisy : {false, true})
        for (const bool drifts : {false, true}) {
            DepthNoise noise(3, focal_px, noisy, drifts);
            std::vector<std::uint16_t> out;
            for (int frame = 0; frame < 3; ++frame)
                noise.apply(wall(nothing_m, 300, 1.5F), frame, 60.0 * frame, out);
            for (std::size_t i = 0; i < pixels; ++i) {
                // The edge jitters by some pixels.
                const bool seen = out[i] != 0;
                ASSERT_FALSE(seen && i % 640 < 290) << i;
                ASSERT_FALSE(seen && i % 640 >= 310 && std::abs(out[i] - 1500) > 60) << i;
            }
        }
}

}  // namespace
}  // namespace touchstone::sim
