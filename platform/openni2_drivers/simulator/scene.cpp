#include "platform/openni2_drivers/simulator/scene.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone::sim {
namespace {

using Vec2 = Eigen::Vector2f;

Vec2 turned(const Shape& shape, const Vec3& offset) {
    const float c = shape.along.x();
    const float s = shape.along.y();
    return {c * offset.x() + s * offset.y(), -s * offset.x() + c * offset.y()};
}

float box_distance(const Shape& box, const Vec3& p) {
    const Vec3 offset = p - box.center;
    const Vec2 flat = turned(box, offset);
    const Vec3 q = Vec3(std::abs(flat.x()), std::abs(flat.y()), std::abs(offset.z())) - box.half +
                   Vec3::Constant(box.radius_m);
    return q.cwiseMax(0.0F).norm() + std::min(q.maxCoeff(), 0.0F) - box.radius_m;
}

float can_distance(const Shape& can, const Vec3& p) {
    const Vec3 offset = p - can.center;
    const Vec2 q(offset.head<2>().norm() - can.half.x() + can.radius_m,
                 std::abs(offset.z()) - can.half.z() + can.radius_m);
    return q.cwiseMax(0.0F).norm() + std::min(q.maxCoeff(), 0.0F) - can.radius_m;
}

/// A spherical shell cut open at the rim, with a round lip.
float bowl_distance(const Shape& bowl, const Vec3& p) {
    const Vec3 offset = p - bowl.center;
    const Vec2 q(offset.head<2>().norm(), offset.z());
    const float rim_z = bowl.depth_m - bowl.radius_m;
    const float rim_x = std::sqrt(bowl.radius_m * bowl.radius_m - rim_z * rim_z);
    const bool over_rim = rim_z * q.x() < rim_x * q.y();
    return (over_rim ? (q - Vec2(rim_x, rim_z)).norm() : std::abs(q.norm() - bowl.radius_m)) -
           bowl.thickness_m;
}

/// A convex arc that runs into the table by a concave one; the profile is the same along the axis.
float ridge_distance(const Shape& ridge, const Vec3& p) {
    const float across = std::abs(turned(ridge, p - ridge.center).y());
    const Vec2 q(across, p.z());
    const float convex_z = ridge.depth_m - ridge.radius_m;
    const float fillet = ridge.thickness_m;
    const float rise = fillet - convex_z;
    const float reach = ridge.radius_m + fillet;
    const float fillet_x = std::sqrt(reach * reach - rise * rise);
    const Vec2 from_convex(across, p.z() - convex_z);
    float nearest = across >= fillet_x ? p.z() : 1e9F;
    if (from_convex.x() * rise <= from_convex.y() * fillet_x)
        nearest = std::min(nearest, from_convex.norm() - ridge.radius_m);
    else if (across < fillet_x)
        nearest = std::min(nearest, fillet - (q - Vec2(fillet_x, fillet)).norm());
    return nearest;
}

}  // namespace

float Shape::distance(const Vec3& p_s) const {
    switch (kind) {
        case Kind::box:
            return box_distance(*this, p_s);
        case Kind::ball:
            return (p_s - center).norm() - radius_m;
        case Kind::can:
            return can_distance(*this, p_s);
        case Kind::bowl:
            return bowl_distance(*this, p_s);
        case Kind::ridge:
            return ridge_distance(*this, p_s);
    }
    return 1e9F;
}

float Shape::distance_bound(const Vec3& p_s) const {
    switch (kind) {
        case Kind::box:
            return (p_s - center).norm() - half.norm();
        case Kind::can:
            return (p_s - center).norm() - std::hypot(half.x(), half.z());
        case Kind::ridge:
            return p_s.z() - depth_m;
        case Kind::ball:
        case Kind::bowl:
            break;
    }
    return (p_s - center).norm() - radius_m - thickness_m;
}

float Scene::distance(const Vec3& p_s) const {
    float nearest = p_s.z();
    for (const Shape& shape : shapes_)
        if (shape.distance_bound(p_s) < nearest) nearest = std::min(nearest, shape.distance(p_s));
    return nearest;
}

int Scene::nearest(const Vec3& p_s) const {
    float distance = p_s.z();
    int which = -1;
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
        const float d = shapes_[i].distance(p_s);
        if (d < distance) {
            distance = d;
            which = static_cast<int>(i);
        }
    }
    return which;
}

Vec3 Scene::normal(const Vec3& p_s) const {
    constexpr float h = 5e-4F;
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = h * Vec3::Unit(axis);
        gradient[axis] = distance(p_s + step) - distance(p_s - step);
    }
    return gradient.normalized();
}

float Scene::resting_height_m(float x_m, float y_m, float radius_m) const {
    float z = 0.6F;
    for (int i = 0; i < 128; ++i) {
        const float free = distance({x_m, y_m, z}) - radius_m;
        if (free < 2e-6F) break;
        z -= free;
    }
    return z;
}

}  // namespace touchstone::sim
