// The sums of Listing 1 and Eq 1 against their reference, and what they must not be misled by.
#include "pipeline/camera_tracking.hpp"

#include <gtest/gtest.h>

#include "tests/reference/listing_1_camera_tracking.hpp"
#include "tests/support/oriented_scene.hpp"

namespace touchstone {
namespace {

using reference::OrientedPicture;
using test::moved;

AlignmentParams params_of(const CameraTrackingConfig& config, int level) {
    const TrackingLevel& limits = config.levels[static_cast<std::size_t>(level)];
    AlignmentParams params{};
    params.noise = config.noise;
    params.centre_p = {0.0f, 0.0f, 1.0f, 0.0f};
    params.max_distance_m = limits.max_distance_m;
    params.min_normal_cos = std::cos(config.max_normal_angle_deg * std::numbers::pi_v<float> / 180.0f);
    params.huber_sigmas = config.huber_sigmas;
    params.cutoff_sigmas = limits.cutoff_sigmas;
    params.reference_sigma_m = static_cast<float>(reference::sigma_m(config.noise, 1.0, 1.0));
    params.intensity_sigma = config.intensity_sigma;
    return params;
}

/// Sums of the kernels for two pictures of one camera.
class Sums {
  public:
    Sums(const Intrinsics& k, const OrientedPicture& live, const OrientedPicture& model,
         const CameraTrackingConfig& config = {})
        : tracking(device_, config, k), live_(device_, make_map_shape(k)), prediction(device_, live_.shape) {
        test::write_live(live, live_);
        test::write_model(model, prediction);
        tracking.prepare(live_);
    }
    AlignmentSums at(const RigidTransform& T_p_c, int level) {
        return tracking.sum(prediction, T_p_c, level);
    }

  private:
    const Device device_{DeviceConfig{}};

  public:
    CameraTracking tracking;

  private:
    LiveMaps live_;

  public:
    SurfacePrediction prediction;
};

/// Entries are compared with what they could be at most (Cauchy and Schwarz): `share` of it.
void expect_same(const AlignmentSums& got, const AlignmentSums& expected, double share) {
    const Vector6d largest = expected.A.diagonal().cwiseSqrt();
    const double residual = std::sqrt(expected.weighted_squares);
    for (int a = 0; a < 6; ++a) {
        EXPECT_NEAR(got.b[a], expected.b[a], share * largest[a] * residual) << "b " << a;
        for (int b = 0; b < 6; ++b)
            EXPECT_NEAR(got.A(a, b), expected.A(a, b), share * largest[a] * largest[b]) << a << " " << b;
    }
    EXPECT_NEAR(got.weight, expected.weight, share * expected.weight);
    EXPECT_NEAR(got.weighted_squares, expected.weighted_squares, share * expected.weighted_squares);
    EXPECT_NEAR(got.squares, expected.squares, share * expected.squares);
    EXPECT_NEAR(got.pairs, expected.pairs, share * expected.pairs);
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
        const AlignmentSums expected =
            reference::sum_alignment(live_level, k_level, model, k, T_p_c, params_of(config, level));
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
            EXPECT_EQ(got.weight + got.weighted_squares + got.squares + got.pairs + got.compared, 0.0);
        }
    }
    // Everything behind the prediction's camera.
    const AlignmentSums behind = Sums(k_, model_, model_).at(moved({0.0f, 0.0f, -5000.0f}), 0);
    EXPECT_EQ(behind.compared, 0.0);
    EXPECT_GT(behind.measured, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, CameraTrackingSums, testing::Values(std::pair{96, 80}, std::pair{70, 50}));

/// No bias by half pixels: an identical view solves to no movement at each level. Half a pixel of the
/// coarsest level would be 15 mm or half a degree here. What is left is of the pixels where two walls meet,
/// whose mean depth lies before both: 0.2 mm and 0.02 degrees at the coarsest level.
TEST(CameraTrackingKernels, AnIdenticalViewSolvesToNoMovementAtEachLevel) {
    for (const auto& [width, height] : {std::pair{160, 128}, {150, 110}}) {
        const Intrinsics k = test::small_camera(width, height);
        const OrientedPicture view = test::view_of(k, test::three_walls(), moved({10.0f, 5.0f, 0.0f}));
        Sums sums(k, view, view);
        for (int level = 0; level < 3; ++level) {
            const TwistSolution solution =
                solve_twist(sums.at(RigidTransform::Identity(), level), 0.5, 0.002);
            EXPECT_EQ(solution.held, 0) << solution.eigenvalues.transpose();
            const test::PoseError bias =
                test::pose_error(twist_about(solution.twist, {0.0f, 0.0f, 1.0f}), RigidTransform::Identity());
            EXPECT_LT(bias.mm, 0.5f) << "level " << level;
            EXPECT_LT(bias.deg, 0.04f) << "level " << level;
        }
    }
}

/// The same for one slanted plane, whose residuals are seen directly: within 0.1 mm.
TEST(CameraTrackingKernels, AnIdenticalSlantedPlaneHasNoResidualAtAnyLevel) {
    const Intrinsics k = test::small_camera();
    const OrientedPicture view =
        test::view_of(k, test::wall({0.4, 0.2, 1.0}, 1.0), RigidTransform::Identity());
    Sums sums(k, view, view);
    for (int level = 0; level < 3; ++level) {
        const AlignmentSums got = sums.at(RigidTransform::Identity(), level);
        EXPECT_GT(got.pairs, 0.95 * got.measured) << level;
        EXPECT_LT(std::sqrt(got.squares / got.pairs), 1e-4) << level;
    }
}

/// Seen from behind, a thin sheet is where its front was, but faces the other way.
TEST(CameraTrackingKernels, TheBackOfAThinSheetDoesNotMatchItsFront) {
    const Intrinsics k = test::small_camera();
    const OrientedPicture front =
        test::view_of(k, test::wall({0.0, 0.0, 1.0}, 1.0), RigidTransform::Identity());
    OrientedPicture back = front;
    for (Eigen::Vector3f& n : back.normals) n = -n;
    const AlignmentSums same = Sums(k, front, front).at(RigidTransform::Identity(), 0);
    EXPECT_EQ(same.pairs, same.compared);
    const AlignmentSums turned = Sums(k, front, back).at(RigidTransform::Identity(), 0);
    EXPECT_EQ(turned.pairs, 0.0);
    EXPECT_GT(turned.compared, 0.0);
}

/// Normals 34 degrees apart match, 36 do not; they are compared in one frame: the live camera is turned.
TEST(CameraTrackingKernels, NormalsAreComparedInOneFrame) {
    const Intrinsics k = test::small_camera();
    const OrientedPicture model =
        test::view_of(k, test::wall({0.0, 0.0, 1.0}, 1.0), RigidTransform::Identity());
    CameraTrackingConfig config;
    config.levels[0] = {4, 10.0f, 1e6f};
    for (const float turned_deg : {-20.0f, 20.0f}) {
        const RigidTransform T_p_c = moved({0.0f, 0.0f, 0.0f}, turned_deg, {0.0f, 1.0f, 0.0f});
        for (const auto& [angle_deg, matches] : {std::pair{34.0f, true}, {36.0f, false}}) {
            OrientedPicture live = model;
            const RigidTransform tilt = moved({0.0f, 0.0f, 0.0f}, angle_deg, {1.0f, 0.0f, 0.0f});
            for (Eigen::Vector3f& n : live.normals)
                n = T_p_c.linear().transpose() * (tilt.linear() * Eigen::Vector3f(0.0f, 0.0f, -1.0f));
            const AlignmentSums sums = Sums(k, live, model, config).at(T_p_c, 0);
            EXPECT_GT(sums.compared, 100.0);
            EXPECT_EQ(sums.pairs, matches ? sums.compared : 0.0) << angle_deg;
        }
    }
}

/// A wall 99 mm before its model: the vertices of pairs are 99 to 120 mm apart, residuals are 99 mm.
TEST(CameraTrackingKernels, PairsAreLimitedByDistanceAndByResidual) {
    const Intrinsics k = test::small_camera();
    const auto wall_at = [&](double z) {
        return test::view_of(k, test::wall({0.0, 0.0, 1.0}, z), RigidTransform::Identity());
    };
    const double sigma_m = reference::sigma_m(SensorNoise{0.0012f, 0.0019f, 0.4f, 0.0f}, 1.001, 1.0);
    for (const auto& [gate_m, cutoff_sigmas, matches] : {std::tuple{0.121, 1e6, true},
                                                         {0.098, 1e6, false},
                                                         {0.2, 0.1 / sigma_m, true},
                                                         {0.2, 0.098 / sigma_m, false}}) {
        CameraTrackingConfig config;
        config.noise.grazing = 0.0f;
        config.levels[0] = {4, static_cast<float>(gate_m), static_cast<float>(cutoff_sigmas)};
        const AlignmentSums sums =
            Sums(k, wall_at(1.001), wall_at(1.1), config).at(RigidTransform::Identity(), 0);
        EXPECT_EQ(sums.pairs, matches ? sums.compared : 0.0) << gate_m << " " << cutoff_sigmas;
    }
}

/// Rows weigh by the sensor's noise: the same wall at 3 m weighs (sigma(1 m) / sigma(3 m))^2 of one at 1 m,
/// and a residual of 3 sigmas half by Huber at 1.5.
TEST(CameraTrackingKernels, RowsWeighByNoiseAndByHuber) {
    const Intrinsics k = test::small_camera();
    CameraTrackingConfig config;
    config.noise.grazing = 0.0f;
    const auto mean_weight = [&](double live_m, double model_m) {
        const auto view = [&](double z) {
            return test::view_of(k, test::wall({0.0, 0.0, 1.0}, z), RigidTransform::Identity());
        };
        const AlignmentSums sums =
            Sums(k, view(live_m), view(model_m), config).at(RigidTransform::Identity(), 0);
        return sums.weight / sums.pairs;
    };
    const double near_m = reference::sigma_m(config.noise, 1.0, 1.0),
                 far_m = reference::sigma_m(config.noise, 3.0, 1.0);
    EXPECT_NEAR(mean_weight(1.0, 1.0), 1.0, 1e-4);
    EXPECT_NEAR(mean_weight(3.0, 3.0), near_m * near_m / (far_m * far_m), 1e-4);
    EXPECT_NEAR(mean_weight(1.0, 1.0 + 3.0 * near_m), 0.5, 1e-3);
    config.noise.grazing = 0.001f;  // the corners of the view are seen aslant
    EXPECT_LT(mean_weight(1.0, 1.0), 0.9);
}

/// Sums do not lose precision with the number of pixels: 300,000 rows give the means that 3,000 give. The
/// wall is 1 mm off, so the residual's mean square is 1 mm^2 to 1 in 10,000.
TEST(CameraTrackingKernels, MeansDoNotDependOnTheNumberOfPixels) {
    for (const auto& [width, height] : {std::pair{64, 48}, {640, 480}}) {
        const Intrinsics k = test::small_camera(width, height);
        const auto view = [&](double z) {
            return test::view_of(k, test::wall({0.0, 0.0, 1.0}, z), RigidTransform::Identity());
        };
        const AlignmentSums sums = Sums(k, view(1.0), view(1.001)).at(RigidTransform::Identity(), 0);
        EXPECT_EQ(sums.pairs, static_cast<double>(width * height));
        EXPECT_NEAR(1e6 * sums.squares / sums.pairs, 1.0, 1e-3);  // depths themselves are exact to 1e-4 mm
        EXPECT_NEAR(sums.A(5, 5) / sums.weight, 1.0, 1e-5);
        EXPECT_NEAR(1000.0 * sums.b[5] / sums.weight, 1.0, 1e-3);
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
    const Device device(DeviceConfig{});
    const CameraTrackingConfig config;
    const RigidTransform T_p_c = moved({20.0f, 15.0f, -25.0f}, 2.0f);
    OrientedPicture live = test::view_of(k_, test::corner(), T_g_p_ * T_p_c);
    const auto live_rgb = texture_of(k_, live, T_g_p_ * T_p_c), model_rgb = texture_of(k_, model_, T_g_p_);
    test::make_holes(live, [](int x, int y) { return (3 * x + 5 * y) % 17 == 0; });
    Sums sums(k_, live, model_, config);
    IntensityMaps live_maps(device, k_), model_maps(device, k_);
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
        const AlignmentSums expected =
            reference::sum_intensity(live, k_level, model_, k_, seen, estimate, params_of(config, level));
        const AlignmentSums got =
            sums.tracking.sum_intensity(sums.prediction, {live_maps, model_maps}, estimate, level);
        EXPECT_GT(expected.pairs, 0.5 * static_cast<double>(live.depth_m.size()));
        expect_same(got, expected, 2e-3);
        k_level = reference::half_intrinsics(k_level);
        live = reference::half_sample(live, k_level, config.half_sample_gap_per_m, config.normal_gap_per_m);
        live_level = reference::half_sample(live_level, 1e9f);
        model_level = reference::half_sample(model_level, 1e9f);
    }
}

/// The step moves live points towards the model: in the frame p, forward where the model is behind.
TEST(CameraTrackingKernels, TheSolutionMovesTowardsTheModel) {
    const Intrinsics k = test::small_camera();
    const RigidTransform T_p_c = moved({6.0f, -4.0f, 5.0f}, 0.5f);
    const OrientedPicture model = test::view_of(k, test::corner(), RigidTransform::Identity());
    const OrientedPicture live = test::view_of(k, test::corner(), T_p_c);
    Sums sums(k, live, model);
    const TwistSolution solution = solve_twist(sums.at(RigidTransform::Identity(), 0), 0.5, 0.002);
    const test::PoseError rest = test::pose_error(twist_about(solution.twist, {0.0f, 0.0f, 1.0f}), T_p_c);
    EXPECT_LT(rest.mm, 3.0f);  // of 8.8 mm, at one step
    EXPECT_LT(rest.deg, 0.15f);
}

}  // namespace
}  // namespace touchstone
