#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace touchstone {

/// A camera's pose at a time, in the frame of its trajectory.
struct TimedPose {
    double time_s = 0.0;
    Eigen::Isometry3d T_w_c = Eigen::Isometry3d::Identity();
};

/// TUM lines "timestamp tx ty tz qx qy qz qw"; # starts a comment. Throws Error: no_input, bad_data.
std::vector<TimedPose> read_trajectory(const std::filesystem::path& file);

/// The truth of a sequence folder: groundtruth.txt, else frame-*.pose.txt at 30 frames a second. Throws
/// Error.
std::vector<TimedPose> read_true_path(const std::filesystem::path& folder);

/// How an estimated path compares with the true one. Lengths in millimetres.
struct PathScore {
    std::size_t matched = 0;                     ///< poses with a true one within 20 ms
    double ate_rmse_mm = 0.0, ate_max_mm = 0.0;  ///< after rigid alignment of the places, without scale
    double drift_mm = 0.0, drift_deg = 0.0;      ///< largest, of poses relative to the first one
};

PathScore score_path(const std::vector<TimedPose>& estimate, const std::vector<TimedPose>& truth);

}  // namespace touchstone
