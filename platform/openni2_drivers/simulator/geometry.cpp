#include "platform/openni2_drivers/simulator/geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::sim {
namespace {

constexpr float missed = -1.0F;

/// Along the ray from a start near the ball, relative to that start; infinity = missed.
float intersect_ball(const Vec3& from_center, const Vec3& direction, float radius) {
    const float along = from_center.dot(direction);
    const float root = along * along - from_center.squaredNorm() + radius * radius;
    return root > 0.0F ? -along - std::sqrt(root) : std::numeric_limits<float>::infinity();
}

}  // namespace

float intersect(const RoundCone& cone, const Vec3& direction) {
    // Starting near the cone keeps the differences of squares exact enough in single precision.
    const float start = direction.dot(0.5F * (cone.a + cone.b));
    const Vec3 axis = cone.b - cone.a;
    const Vec3 from_a = start * direction - cone.a;
    const float taper = cone.radius_a - cone.radius_b;
    const float axis2 = axis.squaredNorm();
    const float d2 = axis2 - taper * taper;
    const float m1 = axis.dot(from_a);
    const float m2 = axis.dot(direction);
    const float m3 = direction.dot(from_a);
    const float k2 = d2 - m2 * m2;
    const float k1 = d2 * m3 - m1 * m2 + m2 * taper * cone.radius_a;
    const float k0 = d2 * from_a.squaredNorm() - m1 * m1 + m1 * taper * cone.radius_a * 2.0F -
                     axis2 * cone.radius_a * cone.radius_a;
    const float root = k1 * k1 - k0 * k2;
    if (d2 > 0.0F && root >= 0.0F && k2 > 0.0F) {
        const float t = (-std::sqrt(root) - k1) / k2;
        const float y = m1 - cone.radius_a * taper + t * m2;
        if (y > 0.0F && y < d2) return start + t;
    }
    const float t = std::min(intersect_ball(from_a, direction, cone.radius_a),
                             intersect_ball(start * direction - cone.b, direction, cone.radius_b));
    return std::isfinite(t) ? start + t : missed;
}

Vec3 normal_at(const RoundCone& cone, const Vec3& point) {
    const Vec3 axis = cone.b - cone.a;
    const float length = axis.norm();
    const float sine = (cone.radius_a - cone.radius_b) / length;
    const Vec3 unit = axis / length;
    const float y = unit.dot(point - cone.a);
    const float aside = (point - cone.a - y * unit).norm();
    // The cone's own normal leans along the axis by the taper; its foot on the axis is where that normal
    // starts.
    const float lean = sine / std::sqrt(std::max(1e-6F, 1.0F - sine * sine));
    const float foot = std::clamp(y - aside * lean, 0.0F, length);
    return (point - cone.a - foot * unit).normalized();
}

}  // namespace touchstone::sim
