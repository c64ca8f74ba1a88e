#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "platform/openni2_drivers/simulator/scene.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"

namespace touchstone::sim {

/// z of the scene at every pixel, metres, row-major. Rendered once: the camera and the scene stand still.
std::vector<float> render_static_depth(const Scene& scene, const TableView& view);

/// Colour of the scene at every pixel, 3 bytes.
std::vector<std::uint8_t> render_static_color(const Scene& scene, const TableView& view,
                                              const std::vector<float>& depth_m);

/// Where a ray first meets the scene; none within ten metres. The direction has unit length.
std::optional<Vec3> first_hit(const Scene& scene, const Vec3& from_s, const Vec3& direction_s);

/// Light from the room on a surface of this colour; normal in the scene frame.
Vec3 shade(const Vec3& albedo, const Vec3& normal_s);

/// 0..1 to a byte.
std::uint8_t to_byte(float value);

}  // namespace touchstone::sim
