#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

/// Lighting of a view in plain C++: Phong's model, the mirrored ray, a sphere on a ray. Global frame, metres.
namespace touchstone::reference {

/// Shares of the light: ambient, diffuse, specular (cos^16).
struct PhongShares {
    float ambient, diffuse, specular;
};

inline Eigen::Vector3f mirrored(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal) {
    return direction - 2.0f * direction.dot(normal) * normal;
}

/// Colour 0..1 of a point of colour `base`. `normal`, `to_light` and `direction` (of the ray that came to
/// the point) have length 1; `light_share`: of the light that arrives.
inline Eigen::Vector3f phong(const PhongShares& shares, const Eigen::Vector3f& base,
                             const Eigen::Vector3f& normal, const Eigen::Vector3f& to_light,
                             const Eigen::Vector3f& direction, float light_share) {
    const float diffuse = std::max(0.0f, normal.dot(to_light));
    const float along = std::max(0.0f, mirrored(-to_light, normal).dot(-direction));
    const float shine = diffuse > 0.0f ? shares.specular * std::pow(along, 16.0f) * light_share : 0.0f;
    const Eigen::Vector3f lit = base * (shares.ambient + shares.diffuse * diffuse * light_share);
    return (lit.array() + shine).cwiseMin(1.0f);
}

/// Where a ray enters a sphere, in units of the direction's length.
inline std::optional<float> sphere_entry(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                         const Eigen::Vector3f& centre, float radius_m) {
    const Eigen::Vector3f from = origin - centre;
    const float a = direction.squaredNorm(), b = from.dot(direction);
    const float discriminant = b * b - a * (from.squaredNorm() - radius_m * radius_m);
    if (discriminant <= 0.0f) return std::nullopt;
    const float t = (-b - std::sqrt(discriminant)) / a;
    return t > 0.0f ? std::optional(t) : std::nullopt;
}

}  // namespace touchstone::reference
