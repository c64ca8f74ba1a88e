#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

namespace touchstone {

/// What is seen of the interactive area: where things that are drawn may lie. Lengths are pixels of the depth
/// picture.
class SurfaceRoom {
  public:
    explicit SurfaceRoom(const Eigen::AlignedBox2f& box_px);
    /// What of a convex four-sided area lies in the box; the whole box where that is nothing.
    SurfaceRoom(const std::array<Eigen::Vector2f, 4>& corners_px, const Eigen::AlignedBox2f& box_px);

    const Eigen::AlignedBox2f& box_px() const { return box_px_; }
    /// From its left to its right edge there.
    std::optional<Eigen::Vector2f> span_px(float y_px) const;
    /// The place nearest by for the middle of an upright box, along the axes, so that the box lies in the
    /// room; in the middle of an axis along which it is too large.
    Eigen::Vector2f nearest_px(const Eigen::Vector2f& center_px, const Eigen::Vector2f& half_box_px) const;

  private:
    std::array<Eigen::Vector2f, 4> corners_px_;
    Eigen::AlignedBox2f box_px_;
};

}  // namespace touchstone
