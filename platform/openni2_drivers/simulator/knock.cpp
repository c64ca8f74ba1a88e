#include "platform/openni2_drivers/simulator/knock.hpp"

#include <numbers>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {
namespace {

Eigen::Vector3d any_direction(Random& random) {
    Eigen::Vector3d direction;
    for (int i = 0; i < 3; ++i) direction[i] = static_cast<double>(random.normal());
    return direction.normalized();
}

}  // namespace

Eigen::Isometry3d knock(const SimulatorConfig& config, double time_s) {
    Eigen::Isometry3d T_before_now = Eigen::Isometry3d::Identity();
    if (time_s < config.knock_s) return T_before_now;
    Random random(config.seed, 0x6e0c6);
    const Eigen::Vector3d axis = any_direction(random);
    const Eigen::Vector3d direction = any_direction(random);
    T_before_now.linear() =
        Eigen::AngleAxisd(config.knock_deg * std::numbers::pi / 180.0, axis).toRotationMatrix();
    T_before_now.translation() = 1e-3 * config.knock_mm * direction;
    return T_before_now;
}

}  // namespace touchstone::sim
