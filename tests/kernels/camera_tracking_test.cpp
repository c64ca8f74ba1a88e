// The sums of Listing 1 and Eq 1 against their reference, at each level of the pyramid.
#include <gtest/gtest.h>

#include "tests/support/alignment_of_two.hpp"

namespace touchstone {
namespace {

using reference::OrientedPicture;
using test::moved;
using Sums = test::AlignmentOfTwo;

/// Entries are compared with what they could be at most (Cauchy and Schwarz): `share` of it.
void expect_same_rows(const AlignmentSums& got, const AlignmentSums& expected, double share) {
    const Vector6d largest = expected.A.diagonal().cwiseSqrt();
    const double residual = std::sqrt(expected.weighted_squares);
    for (int a = 0; a < 6; ++a) {
        EXPECT_NEAR(got.b[a], expected.b[a], share * largest[a] * residual) << "b " << a;
        for (int b = 0; b < 6; ++b)
            EXPECT_NEAR(got.A(a, b), expected.A(a, b), share * largest[a] * largest[b]) << a << " " << b;
    }
}

void expect_same(const AlignmentSums& got, const AlignmentSums& expected, double share) {
    expect_same_rows(got, expected, share);
    EXPECT_NEAR(got.weight, expected.weight, share * expected.weight);
    EXPECT_NEAR(got.weighted_squares, expected.weighted_squares, share * expected.weighted_squares);
    EXPECT_NEAR(got.squares, expected.squares, share * expected.squares);
    EXPECT_NEAR(got.pairs, expected.pairs, share * expected.pairs);
    EXPECT_NEAR(got.close, expected.close, share * expected.pairs);
}

/// Single precision rounds a point to the neighbouring pixel now and then, and a residual over a limit: sums
/// may differ by 1 in 1000, and 1 pixel in 2000 may count or not.
void expect_agreement(const Intrinsics& k, const OrientedPicture& live, const OrientedPicture& model,
                      const RigidTransform& T_p_c) {
    const CameraTrackingConfig config;
    Sums sums(k, live, model, config);
    OrientedPicture live_level = live;
    Intrinsics k_level = k;
    for (int level = 0; level < 3; ++level) {
        SCOPED_TRACE("level " + std::to_string(level));
        const AlignmentSums expected = reference::sum_alignment(
            live_level, k_level, model, k, T_p_c, test::alignment_params(config, level, sums.middle));
        const AlignmentSums got = sums.at(T_p_c, level);
        EXPECT_GT(expected.pairs, 0.25 * expected.measured);
        EXPECT_EQ(got.measured, expected.measured);
        EXPECT_NEAR(got.compared, expected.compared, 1.0 + expected.compared / 2000.0);
        expect_same(got, expected, 1e-3);
        k_level = reference::half_intrinsics(k_level);
        live_level = reference::half_sample(live_level, k_level, config.half_sample_gap_per_m,
                                            config.normal_gap_per_m);
    }
}

class CameraTrackingSums : public testing::TestWithParam<std::pair<int, int>> {
  protected:
    const Intrinsics k_ = test::small_camera(GetParam().first, GetParam().second);
    const RigidTransform T_g_p_ = moved({30.0f, -20.0f, 10.0f}, 2.0f);
    OrientedPicture model_ = test::view_of(k_, test::corner(), T_g_p_);
};

/// The estimate is 15 mm and 0.8 degrees off, so that there are residuals of several sigmas.
TEST_P(CameraTrackingSums, AgreeWithTheReference) {
    const RigidTransform T_p_c = moved({40.0f, 25.0f, -30.0f}, 3.0f);
    const OrientedPicture live = test::view_of(k_, test::corner(), T_g_p_ * T_p_c);
    expect_agreement(k_, live, model_, T_p_c * moved({-8.0f, 10.0f, 7.0f}, 0.8f));
}

TEST_P(CameraTrackingSums, AgreeWithTheReferenceWithHolesEverywhere) {
    const RigidTransform T_p_c = moved({-25.0f, 15.0f, 12.0f}, -2.0f);
    OrientedPicture live = test::view_of(k_, test::corner(), T_g_p_ * T_p_c);
    test::make_holes(live, [](int x, int y) { return (3 * x + 5 * y) % 7 == 0; });
    test::make_holes(model_, [](int x, int y) { return (5 * x + 2 * y) % 11 == 0; });
    expect_agreement(k_, live, model_, T_p_c * moved({4.0f, -3.0f, 5.0f}, 0.3f));
}

TEST_P(CameraTrackingSums, PointsOutsideThePredictionCountAsMeasuredOnly) {
    const RigidTransform T_p_c = moved({450.0f, 120.0f, 60.0f}, 6.0f);
    const OrientedPicture live = test::view_of(k_, test::corner(), T_g_p_ * T_p_c);
    const RigidTransform estimate = T_p_c * moved({3.0f, 2.0f, -4.0f}, 0.2f);
    expect_agreement(k_, live, model_, estimate);
    const AlignmentSums sums = Sums(k_, live, model_).at(estimate, 0);
    EXPECT_LT(sums.compared, 0.8 * sums.measured);
}

TEST_P(CameraTrackingSums, OfNothingAreZero) {
    OrientedPicture nothing = model_;
    test::make_holes(nothing, [](int, int) { return true; });
    for (const auto& [live, model] : {std::pair{nothing, model_}, {model_, nothing}}) {
        Sums sums(k_, live, model);
        for (int level = 0; level < 3; ++level) {
            const AlignmentSums got = sums.at(RigidTransform::Identity(), level);
            EXPECT_TRUE(got.A.isZero(0.0) && got.b.isZero(0.0));
            EXPECT_EQ(got.weight + got.weighted_squares + got.squares + got.pairs + got.close + got.compared,
                      0.0);
        }
    }
    // Everything behind the prediction's camera.
    const AlignmentSums behind = Sums(k_, model_, model_).at(moved({0.0f, 0.0f, -5000.0f}), 0);
    EXPECT_EQ(behind.compared, 0.0);
    EXPECT_GT(behind.measured, 0.0);
}

/// As if the rows between had no depth.
TEST_P(CameraTrackingSums, OverOneRowInSoManyAgreeWithTheReference) {
    const RigidTransform T_p_c = moved({40.0f, 25.0f, -30.0f}, 3.0f);
    const OrientedPicture live = test::view_of(k_, test::corner(), T_g_p_ * T_p_c);
    const RigidTransform estimate = T_p_c * moved({-8.0f, 10.0f, 7.0f}, 0.8f);
    const CameraTrackingConfig config;
    Sums sums(k_, live, model_, config);
    for (const int step : {2, 3, 4}) {
        SCOPED_TRACE("one row in " + std::to_string(step));
        OrientedPicture thinned = live;
        for (std::size_t u = 0; u < thinned.depth_m.size(); ++u)
            if (static_cast<int>(u) / k_.width_px % step != 0) thinned.depth_m[u] = 0.0f;
        const AlignmentSums expected = reference::sum_alignment(
            thinned, k_, model_, k_, estimate, test::alignment_params(config, 0, sums.middle));
        const AlignmentSums got = sums.tracking.sum(sums.prediction, estimate, 0, nullptr, step);
        EXPECT_EQ(got.measured, expected.measured);
        EXPECT_GT(expected.pairs, 0.25 * expected.measured);
        expect_same(got, expected, 1e-3);
    }
}

/// Stripes and spots fixed to the scene, as a camera sees them: brightness 0..1 as 3 equal bytes.
std::vector<std::uint8_t> texture_of(const Intrinsics& k, const OrientedPicture& view,
                                     const RigidTransform& T_g_c) {
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const float z = view.depth_m[static_cast<std::size_t>(y * k.width_px + x)];
            const Eigen::Vector3f p = T_g_c * (z * test::pixel_ray(k, x, y));
            const float value = 127.0f + 60.0f * std::sin(17.0f * p.x()) + 60.0f * std::cos(13.0f * p.y());
            rgb.insert(rgb.end(), 3, static_cast<std::uint8_t>(value));
        }
    }
    return rgb;
}

TEST_P(CameraTrackingSums, OfBrightnessAgreeWithTheReference) {
    const CameraTrackingConfig config;
    const RigidTransform T_p_c = moved({20.0f, 15.0f, -25.0f}, 2.0f);
    OrientedPicture live = test::view_of(k_, test::corner(), T_g_p_ * T_p_c);
    const auto live_rgb = texture_of(k_, live, T_g_p_ * T_p_c), model_rgb = texture_of(k_, model_, T_g_p_);
    test::make_holes(live, [](int x, int y) { return (3 * x + 5 * y) % 17 == 0; });
    Sums sums(k_, live, model_, config);
    IntensityMaps live_maps(sums.device, k_), model_maps(sums.device, k_);
    sums.tracking.convert(live_rgb, live_maps);
    sums.tracking.convert(model_rgb, model_maps);
    reference::Picture live_level{k_.width_px, k_.height_px, reference::brightness(live_rgb)};
    reference::Picture model_level{k_.width_px, k_.height_px, reference::brightness(model_rgb)};
    Intrinsics k_level = k_;
    for (int level = 0; level < 3; ++level) {
        SCOPED_TRACE("level " + std::to_string(level));
        const reference::Brightness seen{level, live_level.width_px, live_level.height_px, live_level.depth_m,
                                         model_level.depth_m};
        const RigidTransform estimate = T_p_c * moved({6.0f, -5.0f, 4.0f}, 0.4f);
        const AlignmentSums expected = reference::sum_intensity(
            live, k_level, model_, k_, seen, estimate, test::alignment_params(config, level, sums.middle));
        const IntensityPair intensity{live_maps, model_maps};
        const AlignmentSums of_depth = sums.at(estimate, level);
        AlignmentSums got = sums.tracking.sum(sums.prediction, estimate, level, &intensity);
        EXPECT_EQ(got.weight, of_depth.weight);
        EXPECT_EQ(got.pairs, of_depth.pairs);
        got.A -= of_depth.A;
        got.b -= of_depth.b;
        EXPECT_GT(expected.pairs, 0.5 * static_cast<double>(live.depth_m.size()));
        expect_same_rows(got, expected, 2e-3);
        k_level = reference::half_intrinsics(k_level);
        live = reference::half_sample(live, k_level, config.half_sample_gap_per_m, config.normal_gap_per_m);
        live_level = reference::half_sample(live_level, 1e9f);
        model_level = reference::half_sample(model_level, 1e9f);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CameraTrackingSums, testing::Values(std::pair{96, 80}, std::pair{70, 50}));

}  // namespace
}  // namespace touchstone
