#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "platform/openni2_drivers/simulator/simulator_source.hpp"

namespace touchstone {

struct TimedPose {
    double time_s = 0.0;
    Eigen::Isometry3d T_s_c = Eigen::Isometry3d::Identity();
};

/// The lines of a file that poses=FILE has written.
inline std::vector<TimedPose> read_poses(const std::filesystem::path& path) {
    std::vector<TimedPose> poses;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        TimedPose pose;
        Eigen::Vector3d t;
        Eigen::Quaterniond q;
        words >> pose.time_s >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w();
        EXPECT_FALSE(words.fail()) << line;
        EXPECT_NEAR(q.norm(), 1.0, 1e-9);
        pose.T_s_c = Eigen::Translation3d(t) * q;
        poses.push_back(pose);
    }
    return poses;
}

/// All frames of a simulation that ends.
inline std::vector<SourceFrame> play(const std::string& uri, bool color = false) {
    const auto source = open_simulator(uri);
    source->enable_color(color);
    std::vector<SourceFrame> frames(1);
    while (source->next(frames.back())) frames.emplace_back();
    frames.pop_back();
    return frames;
}

}  // namespace touchstone
