#include "platform/openni2_drivers/simulator/object_mesh.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "platform/mesh/mesh_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone::sim {
namespace {

const Vec3 clay(0.72F, 0.62F, 0.50F);

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path) {
    MeshFile file = read_mesh_file(path, MeshDetail::shape);
    const std::vector<Vec3> albedo(file.triangles.size(), clay);
    return {std::move(file.positions), std::move(file.triangles), albedo};
}

TriangleMesh make_bowl() {
    constexpr float pi = std::numbers::pi_v<float>;
    constexpr float outer_m = 0.125F, inner_m = 0.119F, lip_m = 0.003F;
    constexpr float squash = 0.64F;  // height over radius
    constexpr int steps = 32;
    // From the pole under the foot, up outside, over the lip, down inside.
    std::vector<Eigen::Vector2f> profile{{0.0F, -squash * outer_m}, {0.036F, -squash * outer_m}};
    profile.insert(profile.end(),
                   {{0.038F, -squash * outer_m - 0.008F}, {0.046F, -squash * outer_m - 0.008F}});
    const float foot_rad = std::acos(0.050F / outer_m);
    for (int i = 0; i <= steps; ++i) {
        const float angle = -foot_rad * (1.0F - static_cast<float>(i) / steps);
        profile.emplace_back(outer_m * std::cos(angle), squash * outer_m * std::sin(angle));
    }
    for (int i = 1; i < 8; ++i) {
        const float angle = pi * static_cast<float>(i) / 8.0F;
        profile.emplace_back(inner_m + lip_m + lip_m * std::cos(angle), lip_m * std::sin(angle));
    }
    for (int i = 0; i <= steps; ++i) {
        const float angle = -0.5F * pi * static_cast<float>(i) / steps;
        const float inner_height_m = squash * outer_m - 0.006F;
        profile.emplace_back(i == steps ? 0.0F : inner_m * std::cos(angle), inner_height_m * std::sin(angle));
    }
    TriangleMesh mesh;
    add_revolved(mesh, Vec3::Zero(), profile, 96, {0.50F, 0.62F, 0.72F});
    for (Vec3& vertex : mesh.vertices) vertex = Vec3(vertex.x(), vertex.z(), -vertex.y());
    return mesh;
}

void fit(TriangleMesh& mesh, double size_m) {
    Eigen::AlignedBox3d box;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) box.extend(mesh.vertices[corner].cast<double>());
    const double longest = box.sizes().maxCoeff();
    if (!(longest > 0.0)) throw Error(ExitStatus::bad_data, "mesh: all corners are one point");
    for (Vec3& vertex : mesh.vertices)
        vertex = (size_m / longest * (vertex.cast<double>() - box.center())).cast<float>();
}

}  // namespace touchstone::sim
