#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "pipeline/types.hpp"
#include "tests/support/analytic_scene.hpp"

namespace touchstone::test {

/// How far along `direction` from `origin`, in units of direction's length, a ray meets a surface; 0:
/// nowhere. Global frame, metres.
using Surface = std::function<float(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction)>;

/// The box from `low` to `high`, seen from outside.
inline Surface box(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    return [=](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
        float enter = 0.0f, leave = 1e9f;
        for (int axis = 0; axis < 3; ++axis) {
            const float slope = std::abs(direction[axis]) < 1e-9f ? 1e-9f : direction[axis];
            const float a = (low[axis] - origin[axis]) / slope, b = (high[axis] - origin[axis]) / slope;
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter < leave ? enter : 0.0f;
    };
}

/// A cylinder of endless length along y.
inline Surface rod_along_y(float x_m, float z_m, float radius_m) {
    return [=](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
        const Eigen::Vector2f o(origin.x() - x_m, origin.z() - z_m), d(direction.x(), direction.z());
        const float b = o.dot(d), c = o.squaredNorm() - radius_m * radius_m;
        const float discriminant = b * b - d.squaredNorm() * c;
        return discriminant > 0.0f ? std::max(0.0f, (-b - std::sqrt(discriminant)) / d.squaredNorm()) : 0.0f;
    };
}

/// The nearest of several.
inline Surface nearest(const std::vector<Surface>& surfaces) {
    return [=](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
        float best = 0.0f;
        for (const Surface& surface : surfaces) {
            const float t = surface(origin, direction);
            if (t > 0.0f && (best <= 0.0f || t < best)) best = t;
        }
        return best;
    };
}

/// width x height depths in metres as the camera at T_g_c sees them; 0 where there is nothing.
inline std::vector<float> view_m(const Intrinsics& k, const Surface& scene, const RigidTransform& T_g_c) {
    return render_depth_m(
        k, [&](const Eigen::Vector3f& ray_c) { return scene(T_g_c.translation(), T_g_c.linear() * ray_c); });
}

}  // namespace touchstone::test
