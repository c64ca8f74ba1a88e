#pragma once

#include "platform/openni2_drivers/simulator/camera_path.hpp"
#include "platform/openni2_drivers/simulator/hand_model.hpp"

namespace touchstone::sim {

/// Somebody of 1.75 m who walks to and fro before a camera that moves, and along with it, so as to stay in
/// its view: a closed formula of the frame's number.
class Person {
  public:
    /// They walk about so far away, and come in from the side from `first_frame` on.
    Person(const CameraPath& path, double distance_m, int first_frame, std::uint64_t seed);

    /// The body in the scene frame s, as parts of a "hand".
    Hand at(int frame) const;
    const HandShape& shape() const { return shape_; }

  private:
    /// Where the feet are, and which way the chest looks: scene frame, z up.
    Placement place(double frame) const;

    CameraPath path_;
    double distance_m_;
    int first_frame_;
    double phase_rad_, period_frames_;
    HandShape shape_;
};

}  // namespace touchstone::sim
