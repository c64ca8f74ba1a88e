#pragma once

#include <Eigen/Core>
#include <vector>

namespace touchstone {

/// A straight piece of a stroke with round ends; both ends the same for a dot.
struct StrokePiece {
    Eigen::Vector2f a_px{0.f, 0.f};
    Eigen::Vector2f b_px{0.f, 0.f};
};

/// Turns the places of one finger into a smooth line: quadratic curves between the middles of successive
/// places, the places their control points. The line follows the finger by half a step and catches up in
/// finish().
class StrokePath {
  public:
    /// A dot, so that a tap leaves a mark.
    StrokePath(const Eigen::Vector2f& start_px, std::vector<StrokePiece>& pieces);
    void move(const Eigen::Vector2f& to_px, std::vector<StrokePiece>& pieces);
    void finish(std::vector<StrokePiece>& pieces);

  private:
    Eigen::Vector2f drawn_to_px_;
    Eigen::Vector2f place_px_;
};

}  // namespace touchstone
