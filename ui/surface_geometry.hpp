#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "platform/display/picture.hpp"
#include "ui/surface_room.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// The depth camera over the surface: how large things are there, where controls may lie, and which point of
/// the scan a finger touched. Places are pixels of the depth picture, centres at whole numbers.
class SurfaceGeometry {
  public:
    /// A camera a metre above, with a view 1.09 m wide: what is taken while a frame does not tell.
    SurfaceGeometry() : SurfaceGeometry(TableFrame{}, {640, 480}) {}
    SurfaceGeometry(const TableFrame& frame, PixelSize view);

    const RigidTransform& T_g_c() const { return T_g_c_; }
    /// Across, on the plane of the interactive area.
    float mm_per_px(const Eigen::Vector2f& place_px) const;
    Eigen::Vector3f point_g_m(const Fingertip& tip) const;
    /// Where a point of the scan is seen; none when it is behind the camera. It may lie beyond the view.
    std::optional<Eigen::Vector2f> pixel_px(const Eigen::Vector3f& point_g_m) const;
    /// Of a length at a point of the scan, in pixels.
    float length_px(const Eigen::Vector3f& point_g_m, float length_mm) const;
    /// The widest upright boxes of that height at the upper and the lower edge of the interactive area, or of
    /// the view when there is no area or it is no base for a row.
    Eigen::AlignedBox2f top_row(float height_px) const;
    Eigen::AlignedBox2f bottom_row(float height_px) const;
    /// Of the interactive area, within the view; the view when there is none.
    const SurfaceRoom& room() const { return room_; }
    /// A direction of the picture as shares of the area's axes: its right is (1,0) where u runs right.
    Eigen::Vector2f along_area(const Eigen::Vector2f& direction_px) const;

  private:
    float depth_m(const Eigen::Vector2f& place_px) const;
    Eigen::AlignedBox2f row(float from_px, float to_px) const;
    Eigen::AlignedBox2f view_box() const;

    PixelSize view_;
    Intrinsics intrinsics_{};
    bool is_camera_known_ = false;
    RigidTransform T_g_c_;
    std::optional<InteractiveArea> area_;
    std::array<Eigen::Vector2f, 4> corners_px_{};
    SurfaceRoom room_;
    float farthest_m_ = 0.f;                // a plane seen farther away is seen too flat
    float top_px_ = 0.f, bottom_px_ = 0.f;  // between them all rows may lie
    bool rows_in_area_ = false;
};

}  // namespace touchstone
