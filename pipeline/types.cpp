#include "pipeline/types.hpp"

namespace touchstone {

InteractiveArea transformed(const RigidTransform& T_new_old, const InteractiveArea& area) {
    return {T_new_old * area.origin_c_m, T_new_old.linear() * area.axis_u_c_m,
            T_new_old.linear() * area.axis_v_c_m};
}

Eigen::Vector2f area_uv(const InteractiveArea& area, const Eigen::Vector3f& point_c_m) {
    const Eigen::Vector3f offset = point_c_m - area.origin_c_m;
    return {offset.dot(area.axis_u_c_m) / area.axis_u_c_m.squaredNorm(),
            offset.dot(area.axis_v_c_m) / area.axis_v_c_m.squaredNorm()};
}

Pose to_pose(const RigidTransform& T) {
    const auto row = [&](int i) { return Float4{T(i, 0), T(i, 1), T(i, 2), T(i, 3)}; };
    return {row(0), row(1), row(2)};
}

}  // namespace touchstone
