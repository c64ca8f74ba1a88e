#pragma once

#include <Eigen/Core>
#include <numbers>

namespace touchstone::sim {

using Vec3 = Eigen::Vector3f;

constexpr float radians(float degrees) { return degrees * std::numbers::pi_v<float> / 180.0F; }

/// The hull of two balls, metres.
struct RoundCone {
    Vec3 a, b;
    float radius_a, radius_b;
};

/// Finds where rays from the origin meet a cone. In double precision: a finger is thin for its distance.
class ConeTracer {
  public:
    explicit ConeTracer(const RoundCone& cone);

    /// The multiple of `ray`, of any length, that is first on the cone; negative = missed.
    float operator()(const Vec3& ray) const;

  private:
    double nearest_ball(const Eigen::Vector3d& ray, double ray2) const;

    Eigen::Vector3d a_, b_, axis_;
    double radius_a_, radius_b_, taper_;
    double d2_, m1_, k0_;  ///< the parts of the quadratic that no ray changes
};

/// Outward unit normal of the cone at a point of its surface.
Vec3 normal_at(const RoundCone& cone, const Vec3& point);

/// Smooth step from 0 to 1 with the least jerk, as hands move.
inline float minimum_jerk(float s) { return s * s * s * (10.0F - 15.0F * s + 6.0F * s * s); }

}  // namespace touchstone::sim
