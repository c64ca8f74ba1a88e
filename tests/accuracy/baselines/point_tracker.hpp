#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/accuracy/baselines/baseline.hpp"

namespace touchstone::baselines {

/// Gives points an id that stays from frame to frame: the nearest pairs of a known point and a new one
/// belong together, as long as they are within the gate.
class PointTracker {
  public:
    /// A point that was missing in more frames on end than `missing_frames` is forgotten.
    PointTracker(double gate_px, int missing_frames) : gate_px_(gate_px), missing_frames_(missing_frames) {}

    /// One id for each point, counted from 1.
    std::vector<int> follow(const std::vector<Eigen::Vector2d>& points_px);
    /// Whether a point of this id is still known, though it may be missing.
    bool knows(int id) const;

  private:
    struct Track {
        int id;
        Eigen::Vector2d pixel_px;
        int missing;
    };

    double gate_px_;
    int missing_frames_;
    std::vector<Track> tracks_;
    int next_id_ = 1;
};

/// The points as touches with their ids.
std::vector<PixelTouch> follow(PointTracker& tracker, const std::vector<Eigen::Vector2d>& points_px);

}  // namespace touchstone::baselines
