#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/accuracy/baselines/direct_zones.hpp"

namespace touchstone::baselines {

struct FingerConfig {
    std::size_t least_arm_px = 100;
    std::size_t least_hand_px = 10;
    std::size_t least_finger_px = 10;
    double least_length_px = 5.0;  ///< from the hand to the farthest pixel
    std::size_t most_tip_flood_px = 30;
    std::size_t height_px = 8;  ///< pixels of the tip that its height is the mean of
};

struct Finger {
    Eigen::Vector2d tip_px = Eigen::Vector2d::Zero();
    float height_mm = 0.0F;  ///< of the tip over the background
};

/// DIRECT's tree: a high blob is an arm, a mid blob at an arm is a hand, a low blob at a hand is a finger.
/// Its tip is the pixel farthest from the hand; from there the finger may run on into the noise.
std::vector<Finger> find_fingers(const Zones& zones, const FingerConfig& config);

}  // namespace touchstone::baselines
