#include "tests/accuracy/path_score.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

namespace fs = std::filesystem;

constexpr double tolerance_s = 0.02;

std::ifstream open(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) throw Error(ExitStatus::no_input, file.string() + " cannot be read");
    return stream;
}

/// A 4x4 matrix; the rotation is made orthonormal.
Eigen::Isometry3d read_matrix(const fs::path& file) {
    std::ifstream stream = open(file);
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 16; ++i) stream >> matrix(i / 4, i % 4);
    if (!stream) throw Error(ExitStatus::bad_data, file.string() + " is not a 4x4 matrix");
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() =
        Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
    T.translation() = matrix.topRightCorner<3, 1>();
    return T;
}

struct Pair {
    Eigen::Isometry3d estimate, truth;
};

std::vector<Pair> match(const std::vector<TimedPose>& estimate, const std::vector<TimedPose>& truth) {
    std::vector<Pair> pairs;
    for (const TimedPose& pose : estimate) {
        const auto nearest = std::ranges::min_element(
            truth, {}, [&](const TimedPose& t) { return std::abs(t.time_s - pose.time_s); });
        if (nearest != truth.end() && std::abs(nearest->time_s - pose.time_s) <= tolerance_s)
            pairs.push_back({pose.T_w_c, nearest->T_w_c});
    }
    return pairs;
}

}  // namespace

std::vector<TimedPose> read_trajectory(const fs::path& file) {
    std::ifstream stream = open(file);
    std::vector<TimedPose> poses;
    std::string line;
    while (std::getline(stream, line)) {
        std::istringstream numbers(line.substr(0, line.find('#')));
        if ((numbers >> std::ws).eof()) continue;
        TimedPose pose;
        Eigen::Vector3d t;
        Eigen::Quaterniond q;
        if (!(numbers >> pose.time_s >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w()))
            throw Error(ExitStatus::bad_data, file.string() + ": not a TUM trajectory: " + line);
        pose.T_w_c = Eigen::Translation3d(t) * q.normalized();
        poses.push_back(pose);
    }
    return poses;
}

std::vector<TimedPose> read_true_path(const fs::path& folder) {
    if (fs::exists(folder / "groundtruth.txt")) return read_trajectory(folder / "groundtruth.txt");
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().string().ends_with(".pose.txt")) files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<TimedPose> poses;
    for (const fs::path& file : files)
        poses.push_back({std::stod(file.filename().string().substr(6, 6)) / 30.0, read_matrix(file)});
    return poses;
}

PathScore score_path(const std::vector<TimedPose>& estimate, const std::vector<TimedPose>& truth) {
    const std::vector<Pair> pairs = match(estimate, truth);
    PathScore score;
    score.matched = pairs.size();
    if (pairs.size() < 5) return score;
    const auto count = static_cast<Eigen::Index>(pairs.size());
    Eigen::Matrix3Xd from(3, count), to(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Pair& pair = pairs[static_cast<std::size_t>(i)];
        from.col(i) = pair.estimate.translation();
        to.col(i) = pair.truth.translation();
        const Eigen::Isometry3d error = (pairs.front().truth.inverse() * pair.truth).inverse() *
                                        (pairs.front().estimate.inverse() * pair.estimate);
        score.drift_mm = std::max(score.drift_mm, 1000.0 * error.translation().norm());
        const double angle = Eigen::AngleAxisd(error.linear()).angle() * 180.0 / std::numbers::pi;
        score.drift_deg = std::max(score.drift_deg, angle);
    }
    const Eigen::Isometry3d aligned(Eigen::umeyama(from, to, false));
    const Eigen::VectorXd errors_m = (to - aligned * from).colwise().norm();
    score.ate_rmse_mm = 1000.0 * std::sqrt(errors_m.squaredNorm() / static_cast<double>(count));
    score.ate_max_mm = 1000.0 * errors_m.maxCoeff();
    return score;
}

}  // namespace touchstone
