#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/shared_types.h"

namespace touchstone {

/// T_a_b takes points of frame b to frame a. Frames: g global (the volume's), c camera.
using RigidTransform = Eigen::Isometry3f;

/// The same as rows of a matrix, as kernels take it.
Pose to_pose(const RigidTransform& T);

/// The camera point that is seen at a place of the picture: D(u) K^-1 [u, 1].
inline Eigen::Vector3f back_project(const Intrinsics& k, float x_px, float y_px, float depth_m) {
    return {(x_px - k.cx_px) / k.fx_px * depth_m, (y_px - k.cy_px) / k.fy_px * depth_m, depth_m};
}
inline Eigen::Vector3f back_project(const Intrinsics& k, int x_px, int y_px, float depth_m) {
    return back_project(k, static_cast<float>(x_px), static_cast<float>(y_px), depth_m);
}

/// Where a camera point with z > 0 is seen: pixels, centres at whole numbers.
inline Eigen::Vector2f project(const Intrinsics& k, const Eigen::Vector3f& point_c_m) {
    return {point_c_m.x() / point_c_m.z() * k.fx_px + k.cx_px,
            point_c_m.y() / point_c_m.z() * k.fy_px + k.cy_px};
}

/// One depth picture, borrowed for the call. Row-major, millimetres, 0 = invalid.
struct DepthView {
    std::span<const std::uint16_t> depth_mm;
    Intrinsics intrinsics{};
};

/// What the table looks like from the depth camera: RGBA, 8 bits, row-major, the size of the depth picture.
/// Alpha 255: background (paint may cover it); alpha 0: moving foreground (paint goes under it).
struct ShadedView {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgba;
};

/// The part of the background that takes touches: a rectangle on a plane, in the camera frame.
/// area_uv = (0,0) at origin, (1,0) at origin + axis_u, (0,1) at origin + axis_v.
struct InteractiveArea {
    Eigen::Vector3f origin_c_m{0.f, 0.f, 0.f};
    Eigen::Vector3f axis_u_c_m{1.f, 0.f, 0.f};
    Eigen::Vector3f axis_v_c_m{0.f, 1.f, 0.f};
};

/// Corners of a polygon on it.
constexpr std::size_t fewest_area_corners = 3, most_area_corners = 12;

/// The same place on the surface in another camera frame.
InteractiveArea transformed(const RigidTransform& T_new_old, const InteractiveArea& area);

/// Unit normal of the area's plane, camera frame, towards the camera.
inline Eigen::Vector3f facing_normal(const InteractiveArea& area) {
    const Eigen::Vector3f normal = area.axis_u_c_m.cross(area.axis_v_c_m).normalized();
    return normal.dot(area.origin_c_m) > 0.0f ? Eigen::Vector3f(-normal) : normal;
}

/// Places of a point of the camera frame in the area: 0..1 inside it, not clamped.
Eigen::Vector2f area_uv(const InteractiveArea& area, const Eigen::Vector3f& point_c_m);

}  // namespace touchstone
