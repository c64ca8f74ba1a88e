#pragma once

#include <Eigen/Geometry>

#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone::sim {

/// Where the camera is at a time, in its own frame before the knock: the identity until knock_s, then turned
/// by knock_deg about an axis and shifted by knock_mm in a direction that follow from the seed.
Eigen::Isometry3d knock(const SimulatorConfig& config, double time_s);

}  // namespace touchstone::sim
