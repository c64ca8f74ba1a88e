#include "ui/mesh_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int rings = 48, segments = 64;
constexpr std::array<std::uint8_t, 4> glaze{98, 190, 204, 255}, clay{226, 140, 78, 255};

/// Radius over height, 0..1: a foot, a belly, a neck and a lip.
float vase_radius(float height) {
    constexpr float pi = std::numbers::pi_v<float>;
    const float belly = 0.24f * std::sin(pi * std::pow(height, 0.8f));
    const float neck = 0.10f + 0.05f * height * height;
    const float foot = 0.07f * std::exp(-30.f * height);
    return belly + neck + foot;
}

std::array<std::uint8_t, 4> mixed(float share) {
    std::array<std::uint8_t, 4> rgba{};
    for (std::size_t i = 0; i < 4; ++i)
        rgba[i] = static_cast<std::uint8_t>(
            std::lround((1.f - share) * static_cast<float>(glaze[i]) + share * static_cast<float>(clay[i])));
    return rgba;
}

/// The glaze has run down in waves.
std::array<std::uint8_t, 4> vase_color(float height, float angle_rad) {
    const float edge = 0.58f + 0.035f * std::sin(5.f * angle_rad) + 0.02f * std::sin(11.f * angle_rad);
    return mixed(std::clamp(1.f - 40.f * (height - edge), 0.f, 1.f));
}

}  // namespace

MeshModel standing(MeshModel model) {
    Eigen::AlignedBox3f box;
    for (const MeshModel::Corner& corner : model.corners) box.extend(corner.position);
    if (box.isEmpty()) return model;
    const float height = box.sizes().y(),
                size = height > 1e-6f ? height : std::max(box.sizes().maxCoeff(), 1e-6f);
    const Vector3f foot(box.center().x(), box.min().y(), box.center().z());
    for (MeshModel::Corner& corner : model.corners) {
        corner.position = (corner.position - foot) / size;
        const float length = corner.normal.norm();
        corner.normal = length > 1e-6f ? Vector3f(corner.normal / length) : Vector3f(Vector3f::UnitY());
    }
    return model;
}

MeshModel make_vase() {
    MeshModel vase;
    for (int ring = 0; ring <= rings; ++ring) {
        const float height = static_cast<float>(ring) / static_cast<float>(rings);
        const float slope = (vase_radius(height + 1e-3f) - vase_radius(height - std::min(height, 1e-3f))) /
                            (1e-3f + std::min(height, 1e-3f));
        for (int segment = 0; segment < segments; ++segment) {
            const float angle = 2.f * std::numbers::pi_v<float> * static_cast<float>(segment) / segments;
            const Vector2f out(std::cos(angle), std::sin(angle));
            const Vector2f at = vase_radius(height) * out;
            vase.corners.push_back({{at.x(), height, at.y()},
                                    Vector3f(out.x(), -slope, out.y()).normalized(),
                                    vase_color(height, angle)});
        }
    }
    const auto corner = [](int ring, int segment) {
        return static_cast<std::uint32_t>(ring * segments + segment % segments);
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            vase.triangles.push_back(
                {corner(ring, segment), corner(ring + 1, segment), corner(ring, segment + 1)});
            vase.triangles.push_back(
                {corner(ring, segment + 1), corner(ring + 1, segment), corner(ring + 1, segment + 1)});
        }
    }
    // Its water: what is seen from above through the mouth.
    const auto middle = static_cast<std::uint32_t>(vase.corners.size());
    vase.corners.push_back({{0.f, 0.94f, 0.f}, Vector3f::UnitY(), {24, 40, 52, 255}});
    for (int segment = 0; segment < segments; ++segment) {
        const float angle = 2.f * std::numbers::pi_v<float> * static_cast<float>(segment) / segments;
        const float radius = 0.98f * vase_radius(0.94f);
        vase.corners.push_back({{radius * std::cos(angle), 0.94f, radius * std::sin(angle)},
                                Vector3f::UnitY(),
                                {24, 40, 52, 255}});
    }
    for (std::uint32_t segment = 0; segment < segments; ++segment)
        vase.triangles.push_back({middle, middle + 1 + (segment + 1) % segments, middle + 1 + segment});
    return vase;
}

}  // namespace touchstone
