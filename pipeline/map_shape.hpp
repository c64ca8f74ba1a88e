#pragma once

#include <cstddef>

#include "kernels/shared_types.h"
#include "pipeline/pixel_region.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

MapShape make_map_shape(const Intrinsics& intrinsics);

inline std::size_t map_pixels(const MapShape& shape) {
    return static_cast<std::size_t>(shape.pitch_px) * static_cast<std::size_t>(shape.rows_px);
}
inline int tiles_per_row(const MapShape& shape) { return shape.pitch_px / TILE_PX; }
inline int tile_count(const MapShape& shape) { return tiles_per_row(shape) * (shape.rows_px / TILE_PX); }
inline std::size_t map_index(const MapShape& shape, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(shape.pitch_px) +
           static_cast<std::size_t>(x);
}

/// One work-item for eight or sixteen pixels along x, over the whole map.
LaunchSize eight_pixels_each(const MapShape& shape);
LaunchSize sixteen_pixels_each(const MapShape& shape);
/// One for eight pixels, over the tiles that hold pixels of the region.
LaunchSize eight_pixels_each(const MapShape& shape, const PixelRegion& region);

}  // namespace touchstone
