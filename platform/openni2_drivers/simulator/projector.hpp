#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "platform/openni2_drivers/simulator/table_view.hpp"

namespace touchstone::sim {

/// A projector as it really is: pinhole, shifted lens, a little distortion (k1, k2, p1, p2 of Brown 1966).
/// Pixel centres lie at whole numbers; its frame p: x right, y down in its picture, z along the light.
struct Projector {
    int width_px = 1280, height_px = 800;
    Eigen::Vector2f focal_px{1.0F, 1.0F};
    Eigen::Vector2f center_px{0.0F, 0.0F};
    std::array<float, 4> distortion{};
    Eigen::Matrix3f rotation_p_s = Eigen::Matrix3f::Identity();
    Vec3 position_s = Vec3::Zero();

    /// Along the light.
    float depth_m(const Vec3& point_s) const { return rotation_p_s.row(2).dot(point_s - position_s); }
    /// The pixel that lights a point, inside the picture or not. Needs depth_m > 0.
    Eigen::Vector2f pixel_px(const Vec3& point_s) const;
    /// Direction of a pixel's light, of any length, scene frame.
    Vec3 ray_s(const Eigen::Vector2f& pixel_px) const;
};

/// Hangs beside the camera and lights all that it sees of the table, drawn from the seed.
Projector make_projector(const TableView& view, std::uint64_t seed);

/// Writes the truth as JSON; T_p_c is from the frame of the camera as it was set up. Throws Error{io_error}.
void write_projector(const std::string& path, const Projector& projector, const TableView& view);

}  // namespace touchstone::sim
