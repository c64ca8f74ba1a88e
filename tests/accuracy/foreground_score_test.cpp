#include "tests/accuracy/foreground_score.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

constexpr Intrinsics k{60.0f, 60.0f, 29.5f, 29.5f, 60, 60, {0, 0}};

/// A square hand of one part, 1 m away, its left edge at `left_px`, before a table at 1.1 m.
sim::Picture square(int left_px, float depth_m = 1.0f) {
    sim::Picture picture{std::vector<float>(3600, 1.1f), std::vector<std::uint8_t>(3600, 0),
                         std::vector<std::uint8_t>(3600, 0)};
    for (int y = 15; y < 45; ++y) {
        for (int x = left_px; x < left_px + 30; ++x) {
            picture.depth_m[static_cast<std::size_t>(y * 60 + x)] = depth_m;
            picture.part[static_cast<std::size_t>(y * 60 + x)] = 1;
        }
    }
    return picture;
}

/// A checkerboard of 1 mm is noise of 1 mm; a slope of any steepness is none, but an error.
TEST(ForegroundScore, TellsNoiseFromAnErrorThatVariesSlowly) {
    const sim::Picture truth = square(15);
    std::vector<float> rough_m = truth.depth_m, sloping_m = truth.depth_m;
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 60; ++x) {
            const auto at = static_cast<std::size_t>(y * 60 + x);
            rough_m[at] += (x + y) % 2 == 0 ? 0.001f : -0.001f;
            sloping_m[at] += 0.0002f * static_cast<float>(x - 15);
        }
    }
    SurfaceErrors rough, sloping;
    const std::array surfaces{ScoredSurface{rough_m, &rough}, ScoredSurface{sloping_m, &sloping}};
    add_surface_errors(k, truth, {0, 0, 1}, surfaces);
    EXPECT_NEAR(rough.noise_mm(), 1.0, 0.05);
    EXPECT_NEAR(rough.mean_mm(), 1.0, 0.01);
    EXPECT_NEAR(sloping.noise_mm(), 0.0, 0.02);
    EXPECT_NEAR(sloping.mean_mm(), 2.9, 0.05) << "0 to 5.8 mm over the square";
    EXPECT_EQ(rough.pixels, 900u);
}

TEST(ForegroundScore, OtherPartsAndOtherHandsDoNotCount) {
    const sim::Picture truth = square(15);
    SurfaceErrors errors;
    const std::array surfaces{ScoredSurface{truth.depth_m, &errors}};
    add_surface_errors(k, truth, {1, 0, 1}, surfaces);
    add_surface_errors(k, truth, {0, 1, 5}, surfaces);
    EXPECT_EQ(errors.pixels, 0u);
}

/// A thing that moves 2 pixels and 3 mm a frame, shown as it was so many frames ago.
class Lag : public testing::TestWithParam<int> {};

TEST_P(Lag, IsFound) {
    std::vector<sim::Picture> pictures;
    for (int frame = 0; frame < LagScore::delays; ++frame)
        pictures.push_back(square(20 - 2 * frame, 1.0f - 0.003f * static_cast<float>(frame)));
    std::vector<const sim::Picture*> truths;
    for (const sim::Picture& picture : pictures) truths.push_back(&picture);
    LagScore score;
    score.add(k, pictures[static_cast<std::size_t>(GetParam() + 1)].depth_m, truths, {20.0f, 30.0f});
    EXPECT_NEAR(score.lag_frames(), GetParam(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(OfFrames, Lag, testing::Values(0, 1, 2, 3));

}  // namespace
}  // namespace touchstone
