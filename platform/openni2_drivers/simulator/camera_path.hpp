#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "platform/openni2_drivers/simulator/room.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone::sim {

/// How a camera moves before a scene, in steps of frames: a closed formula of the frame's number, so that any
/// frame can be asked for. Every motion starts from rest at the viewpoint, and comes back to where it has
/// been.
class CameraPath {
  public:
    CameraPath(CameraMotion motion, const Viewpoint& start, std::uint64_t seed);

    /// T_s_c: camera to scene.
    Eigen::Isometry3d at(int frame) const;

  private:
    /// amplitude sin(2 pi t / period + phase) less its value at t = 0
    struct Wave {
        double amplitude = 0.0;
        double period_frames = 1.0;
        double phase_rad = 0.0;
        double operator()(double frames) const;
    };
    /// Camera's frame at the start: x right, y down, z forward, metres; turned about y, x, z in radians.
    struct Offset {
        Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
        double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
    };

    Offset sweep(double frames) const;
    Offset orbit(double frames) const;
    Offset rpy(double frames) const;
    Offset slide(double frames) const;
    void add_tremor(double frames, Offset& offset) const;

    CameraMotion motion_;
    Viewpoint start_;
    std::array<Wave, 6> waves_;    ///< of the motion: x, y, z, yaw, pitch, roll
    std::array<Wave, 12> tremor_;  ///< two for each of them
};

}  // namespace touchstone::sim
