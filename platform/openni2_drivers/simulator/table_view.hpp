#pragma once

#include <Eigen/Geometry>

#include "kernels/shared_types.h"
#include "platform/openni2_drivers/simulator/geometry.hpp"

namespace touchstone::sim {

/// Of every simulated Kinect v1.
constexpr Intrinsics kinect_intrinsics() { return {575.8F, 575.8F, 319.5F, 239.5F, 640, 480, {0, 0}}; }

/// The simulated Kinect v1 and where it hangs over the table.
struct TableView {
    Intrinsics intrinsics{};
    Eigen::Matrix3f rotation_s_c = Eigen::Matrix3f::Identity();
    Vec3 camera_s = Vec3::Zero();

    Vec3 to_scene(const Vec3& p_c) const { return rotation_s_c * p_c + camera_s; }
    Vec3 to_camera(const Vec3& p_s) const { return rotation_s_c.transpose() * (p_s - camera_s); }
    /// Camera frame, z = 1.
    Vec3 ray_c(float u_px, float v_px) const {
        return {(u_px - intrinsics.cx_px) / intrinsics.fx_px, (v_px - intrinsics.cy_px) / intrinsics.fy_px,
                1.0F};
    }
    /// Needs z > 0.
    Eigen::Vector2f project(const Vec3& p_c) const {
        return {intrinsics.fx_px * p_c.x() / p_c.z() + intrinsics.cx_px,
                intrinsics.fy_px * p_c.y() / p_c.z() + intrinsics.cy_px};
    }
    /// Where the ray of a pixel meets the plane of the table, scene frame.
    Vec3 on_table(float u_px, float v_px) const {
        const Vec3 ray_s = rotation_s_c * ray_c(u_px, v_px);
        return camera_s - ray_s * (camera_s.z() / ray_s.z());
    }
};

/// The optical axis meets the origin of the scene; the tilt leans it towards +y.
TableView make_table_view(double height_m, double tilt_deg);

/// The camera after a movement given in its own frame.
TableView moved_view(const TableView& view, const Eigen::Isometry3d& T_before_now);

/// T_s_c: camera to scene.
Eigen::Isometry3d pose_of(const TableView& view);

}  // namespace touchstone::sim
