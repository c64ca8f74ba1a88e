#include "platform/openni2_drivers/simulator/projector.hpp"

#include <Eigen/Geometry>
#include <fstream>
#include <nlohmann/json.hpp>

#include "platform/openni2_drivers/simulator/random.hpp"
#include "platform/system/error.hpp"

namespace touchstone::sim {
namespace {

using Eigen::Vector2f;

constexpr std::uint64_t stream = 0x9c0ec;
constexpr float margin = 1.06F;  // of the picture over what the camera sees

Vector2f bend(const std::array<float, 4>& d, const Vector2f& p) {
    const float r2 = p.squaredNorm();
    const float radial = 1.0F + r2 * (d[0] + r2 * d[1]);
    return {radial * p.x() + 2.0F * d[2] * p.x() * p.y() + d[3] * (r2 + 2.0F * p.x() * p.x()),
            radial * p.y() + d[2] * (r2 + 2.0F * p.y() * p.y()) + 2.0F * d[3] * p.x() * p.y()};
}

/// Looks straight down, its picture's right where the camera's is, but for a few degrees.
Eigen::Matrix3f draw_rotation(Random& random) {
    const Eigen::Matrix3f down = Eigen::Vector3f(1.0F, -1.0F, -1.0F).asDiagonal();
    const auto turn = [&](const Vec3& axis, float sigma_deg) {
        return Eigen::AngleAxisf(radians(sigma_deg * random.normal()), axis);
    };
    const Eigen::Matrix3f off =
        (turn(Vec3::UnitX(), 2.0F) * turn(Vec3::UnitY(), 2.0F) * turn(Vec3::UnitZ(), 1.5F))
            .toRotationMatrix();
    return off * down;
}

/// The box on the table that the camera sees.
Eigen::AlignedBox2f seen_box(const TableView& view) {
    Eigen::AlignedBox2f box;
    for (const float u : {0.0F, 639.0F})
        for (const float v : {0.0F, 479.0F}) box.extend(Vector2f(view.on_table(u, v).head<2>()));
    return box;
}

}  // namespace

Vector2f Projector::pixel_px(const Vec3& point_s) const {
    const Vec3 p = rotation_p_s * (point_s - position_s);
    return focal_px.cwiseProduct(bend(distortion, p.head<2>() / p.z())) + center_px;
}

Vec3 Projector::ray_s(const Vector2f& pixel_px) const {
    const Vector2f seen = (pixel_px - center_px).cwiseQuotient(focal_px);
    Vector2f ideal = seen;
    for (int step = 0; step < 20; ++step) ideal += seen - bend(distortion, ideal);
    return rotation_p_s.transpose() * Vec3(ideal.x(), ideal.y(), 1.0F);
}

Projector make_projector(const TableView& view, std::uint64_t seed) {
    Random random(seed, stream);
    const Eigen::AlignedBox2f seen = seen_box(view);
    const Vector2f middle = seen.center();
    Projector projector;
    projector.rotation_p_s = draw_rotation(random);
    // A wall's arm holds it over the far edge; the lens shift throws the picture from there on to the table.
    projector.position_s = {middle.x() + 0.08F * random.normal(),
                            middle.y() + 0.45F * seen.sizes().y() + 0.05F * random.normal(),
                            view.camera_s.z() * random.uniform(1.1F, 1.35F)};
    const float px_per_m = std::min(static_cast<float>(projector.width_px) / seen.sizes().x(),
                                    static_cast<float>(projector.height_px) / seen.sizes().y()) /
                           margin;
    const float focal_px = px_per_m * projector.position_s.z();
    projector.focal_px = {focal_px, focal_px};
    projector.distortion = {random.uniform(0.01F, 0.03F), random.uniform(-0.01F, 0.0F),
                            random.uniform(-0.0005F, 0.0005F), random.uniform(-0.0005F, 0.0005F)};
    const Vector2f unshifted_px = projector.pixel_px({middle.x(), middle.y(), 0.0F});
    projector.center_px = Vector2f(0.5F * static_cast<float>(projector.width_px - 1),
                                   0.5F * static_cast<float>(projector.height_px - 1)) -
                          unshifted_px;
    return projector;
}

void write_projector(const std::string& path, const Projector& projector, const TableView& view) {
    Eigen::Matrix4f T_p_c = Eigen::Matrix4f::Identity();
    T_p_c.topLeftCorner<3, 3>() = projector.rotation_p_s * view.rotation_s_c;
    T_p_c.topRightCorner<3, 1>() = projector.rotation_p_s * (view.camera_s - projector.position_s);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (int row = 0; row < 4; ++row)
        rows.push_back({T_p_c(row, 0), T_p_c(row, 1), T_p_c(row, 2), T_p_c(row, 3)});
    nlohmann::ordered_json truth;
    truth["width_px"] = projector.width_px;
    truth["height_px"] = projector.height_px;
    truth["focal_px"] = {projector.focal_px.x(), projector.focal_px.y()};
    truth["center_px"] = {projector.center_px.x(), projector.center_px.y()};
    truth["distortion"] = projector.distortion;
    truth["T_p_c"] = rows;
    std::ofstream file(path);
    file << truth.dump(2) << "\n";
    file.close();
    if (!file) throw Error(ExitStatus::io_error, "cannot write " + path);
}

}  // namespace touchstone::sim
