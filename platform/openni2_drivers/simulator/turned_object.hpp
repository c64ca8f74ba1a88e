#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace touchstone::sim {

/// How an object is turned by hand before a camera: strokes of 45 degrees with pauses to take hold anew. Once
/// around the vertical, then the top towards the camera, over, and the bottom towards it; then all of it
/// backwards, and so on. Frame w: the camera at the origin, x to its right, y away from it, z up. The
/// object's own y is up at the start, its z towards the camera.
class TurnedObject {
  public:
    static constexpr int strokes = 14;
    static constexpr int pause_frames = 13;
    static constexpr int stroke_frames = 32;
    static constexpr int period_frames = pause_frames + stroke_frames;  ///< a pause, then a stroke
    static constexpr int frames = strokes * period_frames + pause_frames;
    static constexpr double distance_m = 0.75;

    explicit TurnedObject(std::uint64_t seed);

    /// T_w_o: object to w, at a time from 0 to `frames`.
    Eigen::Isometry3d at(double frame) const;

    /// The time in the play, forwards and backwards, of any frame.
    static int folded(int frame);

  private:
    double side_;  ///< of the first turn, 1 or -1
    double phase_rad_;
};

}  // namespace touchstone::sim
