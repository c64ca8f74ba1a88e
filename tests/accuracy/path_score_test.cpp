#include "tests/accuracy/path_score.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

std::vector<TimedPose> bent_path() {
    std::vector<TimedPose> path;
    for (int i = 0; i < 40; ++i) {
        const double t = 0.1 * i;
        TimedPose pose{t, Eigen::Isometry3d::Identity()};
        pose.T_w_c = Eigen::Translation3d(t, std::sin(t), 0.2 * t * t) *
                     Eigen::AngleAxisd(0.1 * t, Eigen::Vector3d::UnitY());
        path.push_back(pose);
    }
    return path;
}

TEST(PathScore, AnotherWorldFrameIsNoError) {
    const auto truth = bent_path();
    auto estimate = truth;
    const Eigen::Isometry3d T_e_t =
        Eigen::Translation3d(1, -2, 3) * Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized());
    for (TimedPose& pose : estimate) pose.T_w_c = T_e_t * pose.T_w_c;
    const PathScore score = score_path(estimate, truth);
    EXPECT_EQ(score.matched, 40U);
    EXPECT_NEAR(score.ate_rmse_mm, 0.0, 1e-6);
    EXPECT_NEAR(score.drift_mm, 0.0, 1e-6);
    EXPECT_NEAR(score.drift_deg, 0.0, 1e-5);
}

TEST(PathScore, ScaleIsAnError) {
    const auto truth = bent_path();
    auto estimate = truth;
    for (TimedPose& pose : estimate) pose.T_w_c.translation() *= 1.1;
    const double length_mm =
        1000.0 * (truth.back().T_w_c.translation() - truth.front().T_w_c.translation()).norm();
    const PathScore score = score_path(estimate, truth);
    EXPECT_GT(score.ate_rmse_mm, 0.02 * length_mm);
    EXPECT_NEAR(score.drift_mm, 0.1 * length_mm, 0.001 * length_mm);
}

TEST(PathScore, PosesWithoutATrueOneAreNotMatched) {
    const auto truth = bent_path();
    auto estimate = truth;
    for (TimedPose& pose : estimate) pose.time_s += 0.03;
    EXPECT_EQ(score_path(estimate, truth).matched, 0U);
}

TEST(PathScore, OneJumpIsTheLargestError) {
    const auto truth = bent_path();
    auto estimate = truth;
    estimate[20].T_w_c.translation().z() += 0.5;
    const PathScore score = score_path(estimate, truth);
    EXPECT_NEAR(score.ate_max_mm, 500.0, 40.0);
    EXPECT_NEAR(score.drift_mm, 500.0, 1e-6);
}

TEST(PathScore, TrajectoryFilesAreRead) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "groundtruth.txt") << "# comment\n1.5 1 2 3 0 0 0.70710678 0.70710678\n";
    const auto path = read_true_path(folder.path());
    ASSERT_EQ(path.size(), 1U);
    EXPECT_DOUBLE_EQ(path[0].time_s, 1.5);
    EXPECT_TRUE((path[0].T_w_c * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1, 3, 3), 1e-6));
}

}  // namespace
}  // namespace touchstone
