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

/// Distance along a ray from the origin (unit direction) to the cone, in metres; negative = missed.
float intersect(const RoundCone& cone, const Vec3& direction);

/// Outward unit normal of the cone at a point of its surface.
Vec3 normal_at(const RoundCone& cone, const Vec3& point);

/// Smooth step from 0 to 1 with the least jerk, as hands move.
inline float minimum_jerk(float s) { return s * s * s * (10.0F - 15.0F * s + 6.0F * s * s); }

}  // namespace touchstone::sim
