#include "platform/openni2_drivers/simulator/table_view.hpp"

#include <cmath>

namespace touchstone::sim {

TableView make_table_view(double height_m, double tilt_deg) {
    TableView view;
    view.intrinsics = kinect_intrinsics();
    const float tilt = radians(static_cast<float>(tilt_deg));
    const float height = static_cast<float>(height_m);
    view.rotation_s_c.col(0) = Vec3(1.0F, 0.0F, 0.0F);
    view.rotation_s_c.col(1) = Vec3(0.0F, -std::cos(tilt), -std::sin(tilt));
    view.rotation_s_c.col(2) = Vec3(0.0F, std::sin(tilt), -std::cos(tilt));
    view.camera_s = {0.0F, -height * std::tan(tilt), height};
    return view;
}

TableView moved_view(const TableView& view, const Eigen::Isometry3d& T_before_now) {
    TableView moved = view;
    moved.rotation_s_c = view.rotation_s_c * T_before_now.linear().cast<float>();
    moved.camera_s = view.to_scene(T_before_now.translation().cast<float>());
    return moved;
}

Eigen::Isometry3d pose_of(const TableView& view) {
    Eigen::Isometry3d T_s_c = Eigen::Isometry3d::Identity();
    T_s_c.linear() = Eigen::Quaterniond(view.rotation_s_c.cast<double>()).normalized().toRotationMatrix();
    T_s_c.translation() = view.camera_s.cast<double>();
    return T_s_c;
}

}  // namespace touchstone::sim
