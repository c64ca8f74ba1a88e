#include "pipeline/map_shape.hpp"

namespace touchstone {

MapShape make_map_shape(const Intrinsics& intrinsics) {
    const auto padded = [](int size_px) {
        return static_cast<int>(round_up(static_cast<std::size_t>(size_px), TILE_PX));
    };
    return {intrinsics.width_px, intrinsics.height_px, padded(intrinsics.width_px),
            padded(intrinsics.height_px)};
}

LaunchSize eight_pixels_each(const MapShape& shape) {
    const auto columns = static_cast<std::size_t>(shape.pitch_px / 8);
    return {{columns, static_cast<std::size_t>(shape.rows_px), 1}, {2, TILE_PX, 1}};
}

LaunchSize sixteen_pixels_each(const MapShape& shape) {
    const auto columns = static_cast<std::size_t>(shape.pitch_px / TILE_PX);
    return {{columns, static_cast<std::size_t>(shape.rows_px), 1}, {1, TILE_PX, 1}};
}

LaunchSize eight_pixels_each(const MapShape& shape, const PixelRegion& region) {
    const PixelRegion tiles = whole_blocks(region, TILE_PX, shape.pitch_px, shape.rows_px);
    return {{static_cast<std::size_t>(tiles.width_px() / 8), static_cast<std::size_t>(tiles.height_px()), 1},
            {2, TILE_PX, 1},
            {static_cast<std::size_t>(tiles.x0 / 8), static_cast<std::size_t>(tiles.y0), 0}};
}

}  // namespace touchstone
