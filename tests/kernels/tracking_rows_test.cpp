// Which pairs count in Eq 1, how much they weigh, and that none of it is biased.
#include <gtest/gtest.h>

#include "tests/support/alignment_of_two.hpp"

namespace touchstone {
namespace {

using reference::OrientedPicture;
using test::moved;
using Sums = test::AlignmentOfTwo;

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
                test::pose_error(twist_about(solution.twist, sums.middle), RigidTransform::Identity());
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
    config.max_normal_angle_deg = 35.0f;
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
/// and a residual of 3 sigmas half by Huber at 1.5, of which Tukey at 8 leaves (1 - (3 / 8)^2)^2 = 0.7385.
TEST(CameraTrackingKernels, RowsWeighByNoiseAndByResidual) {
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
    EXPECT_NEAR(mean_weight(1.0, 1.0 + 3.0 * near_m), 0.5 * 0.7385, 1e-3);
    EXPECT_LT(mean_weight(1.0, 1.0 + 7.9 * near_m), 1e-3);  // no step at the cut-off
    config.noise.grazing = 0.001f;                          // the corners of the view are seen aslant
    EXPECT_LT(mean_weight(1.0, 1.0), 0.9);
}

/// A residual of 1.9 sigmas is close, one of 2.1 is a pair only, and what the cut-off or the distance leaves
/// out is neither.
TEST(CameraTrackingKernels, PairsWithinTwoSigmasAreClose) {
    const Intrinsics k = test::small_camera();
    CameraTrackingConfig config;
    config.noise.grazing = 0.0f;
    const double sigma_m = reference::sigma_m(config.noise, 1.0, 1.0);
    const auto sums_at = [&](double sigmas) {
        const auto view = [&](double z) {
            return test::view_of(k, test::wall({0.0, 0.0, 1.0}, z), RigidTransform::Identity());
        };
        return Sums(k, view(1.0), view(1.0 + sigmas * sigma_m), config).at(RigidTransform::Identity(), 0);
    };
    for (const double sign : {-1.0, 1.0}) {
        EXPECT_GT(sums_at(1.9 * sign).close, 100.0);
        EXPECT_EQ(sums_at(1.9 * sign).close, sums_at(1.9 * sign).pairs);
        EXPECT_EQ(sums_at(2.1 * sign).close, 0.0);
        EXPECT_GT(sums_at(2.1 * sign).pairs, 100.0);
    }
    config.levels[0].cutoff_sigmas = 1.0f;
    EXPECT_EQ(sums_at(1.5).close, 0.0);
    config.levels[0] = {4, 0.001f, 8.0f};
    EXPECT_EQ(sums_at(1.5).close, 0.0);
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

/// The step moves live points towards the model: in the frame p, forward where the model is behind.
TEST(CameraTrackingKernels, TheSolutionMovesTowardsTheModel) {
    const Intrinsics k = test::small_camera();
    const RigidTransform T_p_c = moved({6.0f, -4.0f, 5.0f}, 0.5f);
    const OrientedPicture model = test::view_of(k, test::corner(), RigidTransform::Identity());
    const OrientedPicture live = test::view_of(k, test::corner(), T_p_c);
    Sums sums(k, live, model);
    const TwistSolution solution = solve_twist(sums.at(RigidTransform::Identity(), 0), 0.5, 0.002);
    const test::PoseError rest = test::pose_error(twist_about(solution.twist, sums.middle), T_p_c);
    EXPECT_LT(rest.mm, 3.0f);  // of 8.8 mm, at one step
    EXPECT_LT(rest.deg, 0.15f);
}

}  // namespace
}  // namespace touchstone
