#include "pipeline/touch_map.hpp"

#include "pipeline/kernel_program.hpp"

namespace touchstone {

TouchMapping::TouchMapping(const Device& device, const TouchMapConfig& config, const Intrinsics& intrinsics)
    : intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      params_{config.noise, config.finger_thickness_m, config.threshold_sigmas, {0, 0}},
      program_(load_kernel_program(device, "listing_4_touch_map.cl")),
      touch_map_(program_.kernel("touch_map")) {}

void TouchMapping::update(const Buffer<float>& live_m, const Buffer<std::uint8_t>& mask,
                          const SurfacePrediction& background, std::span<const PixelRegion> boxes,
                          TouchMap& map) {
    map.touch.fill(0);
    for (const PixelRegion& box : boxes) {
        if (box.empty()) continue;
        const int origin_x = box.x0 / TILE_PX * TILE_PX, origin_y = box.y0 / TILE_PX * TILE_PX;
        const auto columns = round_up(static_cast<std::size_t>(box.x1 - origin_x), TILE_PX) / 8;
        const auto rows = round_up(static_cast<std::size_t>(box.y1 - origin_y), TILE_PX);
        const LaunchSize size{{columns, rows, 1}, {2, TILE_PX, 1}};
        touch_map_.launch(size, live_m, mask, background.depth_m, background.normals_c, map.height_m,
                          map.touch, origin_x, origin_y, intrinsics_, shape_, params_);
    }
}

}  // namespace touchstone
