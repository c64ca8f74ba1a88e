#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace touchstone::sim {
namespace {

std::uint32_t next_index(const TriangleMesh& mesh) {
    return static_cast<std::uint32_t>(mesh.vertices.size());
}

void add_triangle(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, const Vec3& albedo) {
    mesh.triangles.push_back({a, b, c});
    mesh.albedo.push_back(albedo);
}

/// Moves what was added since `first` from the body's own frame to its place.
void place(TriangleMesh& mesh, std::uint32_t first, const Placement& placement) {
    for (std::size_t i = first; i < mesh.vertices.size(); ++i)
        mesh.vertices[i] = (placement.axes * mesh.vertices[i] + placement.center).eval();
}

}  // namespace

Placement upright(const Vec3& center, float yaw_rad) {
    return {center, Eigen::AngleAxisf(yaw_rad, Vec3::UnitZ()).toRotationMatrix()};
}

void add_box(TriangleMesh& mesh, const Placement& placement, const Vec3& half, const Vec3& albedo) {
    const std::uint32_t first = next_index(mesh);
    for (int corner = 0; corner < 8; ++corner)
        mesh.vertices.emplace_back(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                                   corner & 4 ? half.z() : -half.z());
    place(mesh, first, placement);
    constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& side : sides) {
        add_triangle(mesh, first + side[0], first + side[1], first + side[2], albedo);
        add_triangle(mesh, first + side[0], first + side[2], first + side[3], albedo);
    }
}

void add_ball(TriangleMesh& mesh, const Vec3& center, float radius_m, const Vec3& albedo) {
    constexpr int rings = 20;
    std::vector<Eigen::Vector2f> profile;
    for (int i = 0; i <= rings; ++i) {
        const float angle = std::numbers::pi_v<float> * (static_cast<float>(i) / rings - 0.5F);
        profile.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
    }
    add_revolved(mesh, center, profile, 2 * rings, albedo);
}

void add_cylinder(TriangleMesh& mesh, const Placement& placement, float radius_m, float half_m,
                  const Vec3& albedo) {
    constexpr int segments = 32;
    const std::uint32_t first = next_index(mesh);
    add_revolved(mesh, Vec3::Zero(),
                 {{0.0F, -half_m}, {radius_m, -half_m}, {radius_m, half_m}, {0.0F, half_m}}, segments,
                 albedo);
    place(mesh, first, placement);
}

void add_revolved(TriangleMesh& mesh, const Vec3& foot, const std::vector<Eigen::Vector2f>& profile,
                  int segments, const Vec3& albedo) {
    const std::uint32_t bottom = next_index(mesh);
    const auto count = static_cast<std::uint32_t>(segments);
    const auto rings = static_cast<std::uint32_t>(profile.size() - 2);
    mesh.vertices.push_back(foot + Vec3(0.0F, 0.0F, profile.front().y()));
    for (std::uint32_t ring = 1; ring <= rings; ++ring)
        for (int i = 0; i < segments; ++i) {
            const float angle =
                2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(segments);
            const float radius_m = profile[ring].x();
            mesh.vertices.push_back(
                foot + Vec3(radius_m * std::cos(angle), radius_m * std::sin(angle), profile[ring].y()));
        }
    const std::uint32_t top = next_index(mesh);
    mesh.vertices.push_back(foot + Vec3(0.0F, 0.0F, profile.back().y()));
    const auto at = [&](std::uint32_t ring, std::uint32_t i) {
        return bottom + 1 + ring * count + i % count;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        add_triangle(mesh, bottom, at(0, i + 1), at(0, i), albedo);
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            add_triangle(mesh, at(ring, i), at(ring, i + 1), at(ring + 1, i + 1), albedo);
            add_triangle(mesh, at(ring, i), at(ring + 1, i + 1), at(ring + 1, i), albedo);
        }
        add_triangle(mesh, at(rings - 1, i), at(rings - 1, i + 1), top, albedo);
    }
}

void add_quad(TriangleMesh& mesh, const Vec3& corner, const Vec3& along, const Vec3& up, const Vec3& albedo) {
    const std::uint32_t first = next_index(mesh);
    mesh.vertices.insert(mesh.vertices.end(), {corner, corner + along, corner + along + up, corner + up});
    add_triangle(mesh, first, first + 1, first + 2, albedo);
    add_triangle(mesh, first, first + 2, first + 3, albedo);
}

Vec3 triangle_normal(const TriangleMesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Eigen::Vector3d origin = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d cross =
        (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin);
    const double length = cross.norm();
    if (length == 0.0) return Vec3::Zero();
    return (cross / length).cast<float>();
}

}  // namespace touchstone::sim
