#include "platform/openni2_drivers/simulator/geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::sim {

ConeTracer::ConeTracer(const RoundCone& cone)
    : a_(cone.a.cast<double>()),
      b_(cone.b.cast<double>()),
      axis_(b_ - a_),
      radius_a_(static_cast<double>(cone.radius_a)),
      radius_b_(static_cast<double>(cone.radius_b)),
      taper_(radius_a_ - radius_b_),
      d2_(axis_.squaredNorm() - taper_ * taper_),
      m1_(-axis_.dot(a_)),
      k0_(d2_ * a_.squaredNorm() - m1_ * m1_ + 2.0 * m1_ * taper_ * radius_a_ -
          axis_.squaredNorm() * radius_a_ * radius_a_) {}

float ConeTracer::operator()(const Vec3& ray) const {
    const Eigen::Vector3d direction = ray.cast<double>();
    const double ray2 = direction.squaredNorm();
    const double m2 = axis_.dot(direction);
    const double m3 = -a_.dot(direction);
    const double k2 = d2_ * ray2 - m2 * m2;
    const double k1 = d2_ * m3 - m1_ * m2 + m2 * taper_ * radius_a_;
    const double root = k1 * k1 - k0_ * k2;
    if (d2_ > 0.0) {
        // The endless cone around both balls is missed, so are they.
        if (root < 0.0) return -1.0F;
        const double t = (-std::sqrt(root) - k1) / k2;
        const double y = m1_ - radius_a_ * taper_ + t * m2;
        if (k2 > 0.0 && y > 0.0 && y < d2_) return static_cast<float>(t);
    }
    return static_cast<float>(nearest_ball(direction, ray2));
}

double ConeTracer::nearest_ball(const Eigen::Vector3d& ray, double ray2) const {
    constexpr double missed = std::numeric_limits<double>::infinity();
    const auto ball = [&](const Eigen::Vector3d& center, double radius) {
        const double along = ray.dot(center);
        const double root = along * along - ray2 * (center.squaredNorm() - radius * radius);
        return root > 0.0 ? (along - std::sqrt(root)) / ray2 : missed;
    };
    const double t = std::min(ball(a_, radius_a_), ball(b_, radius_b_));
    return t < missed ? t : -1.0;
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
