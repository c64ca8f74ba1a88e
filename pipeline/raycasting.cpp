#include "pipeline/raycasting.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

LaunchSize eight_bricks_each(std::size_t bricks) {
    return {{round_up(ceil_div(bricks, 8), 8), 1, 1}, {8, 1, 1}};
}

}  // namespace

Raycasting::Raycasting(const Device& device, const Intrinsics& intrinsics)
    : device_(&device),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      selection_(load_kernel_program(device, "brick_selection.cl")),
      raycast_(load_kernel_program(device, "listing_3_raycast.cl")),
      brick_range_image_(selection_.kernel("brick_range_image")),
      flag_brick_tiles_(selection_.kernel("flag_brick_tiles")),
      raycast_kernel_(raycast_.kernel("raycast")),
      tile_near_(device, static_cast<std::size_t>(tile_count(shape_))),
      tile_far_(device, static_cast<std::size_t>(tile_count(shape_))),
      tiles_(device, static_cast<std::size_t>(tile_count(shape_))),
      flags_(device, static_cast<std::size_t>(tile_count(shape_))) {}

void Raycasting::raycast(const TsdfVolume& volume, const RigidTransform& T_g_c,
                         SurfacePrediction& prediction) {
    update_ranges(volume, T_g_c);
    {
        const auto tiles = tiles_.map_write();
        std::iota(tiles.values().begin(), tiles.values().end(), 0);
    }
    launch(volume, T_g_c, tile_count(shape_), prediction);
}

void Raycasting::raycast(const TsdfVolume& volume, const RigidTransform& T_g_c, const PixelRegion& region,
                         SurfacePrediction& prediction) {
    if (region.empty()) return;
    update_ranges(volume, T_g_c);
    int count = 0;
    {
        const auto tiles = tiles_.map_write();
        for (int y = region.y0 / TILE_PX; y <= (region.y1 - 1) / TILE_PX; ++y) {
            for (int x = region.x0 / TILE_PX; x <= (region.x1 - 1) / TILE_PX; ++x)
                tiles[static_cast<std::size_t>(count++)] = y * tiles_per_row(shape_) + x;
        }
    }
    launch(volume, T_g_c, count, prediction);
}

void Raycasting::refresh(const TsdfVolume& volume, const RigidTransform& T_g_c,
                         std::span<const int> changed_bricks, SurfacePrediction& prediction) {
    if (changed_bricks.empty()) return;
    update_ranges(volume, T_g_c);
    if (bricks_.size() < changed_bricks.size()) bricks_ = Buffer<int>(*device_, 2 * changed_bricks.size());
    bricks_.write(changed_bricks);
    flags_.fill(0);
    flag_brick_tiles_.launch(eight_bricks_each(changed_bricks.size()), bricks_,
                             static_cast<int>(changed_bricks.size()), flags_, volume.params(), intrinsics_,
                             shape_, to_pose(T_g_c.inverse()));
    int count = 0;
    {
        const auto flags = flags_.map_read();
        const auto tiles = tiles_.map_write();
        for (std::size_t tile = 0; tile < flags.size(); ++tile) {
            if (flags[tile] != 0) tiles[static_cast<std::size_t>(count++)] = static_cast<int>(tile);
        }
    }
    if (count > 0) launch(volume, T_g_c, count, prediction);
}

void Raycasting::raycast_tiles(const TsdfVolume& volume, const RigidTransform& T_g_c,
                               std::span<const int> tiles, SurfacePrediction& prediction) {
    if (tiles.empty()) return;
    update_ranges(volume, T_g_c);
    std::ranges::copy(tiles, tiles_.map_write().values().begin());
    launch(volume, T_g_c, static_cast<int>(tiles.size()), prediction);
}

void Raycasting::update_ranges(const TsdfVolume& volume, const RigidTransform& T_g_c) {
    tile_near_.fill(std::bit_cast<int>(std::numeric_limits<float>::max()));
    tile_far_.fill(0);
    if (volume.bricks_in_use() == 0) return;
    brick_range_image_.launch(eight_bricks_each(static_cast<std::size_t>(volume.bricks_in_use())),
                              volume.brick_of_slot(), volume.bricks_in_use(), volume.has_inside(), tile_near_,
                              tile_far_, volume.params(), intrinsics_, shape_, to_pose(T_g_c.inverse()));
}

void Raycasting::launch(const TsdfVolume& volume, const RigidTransform& T_g_c, int tiles,
                        SurfacePrediction& prediction) {
    const LaunchSize size{{TILE_PX * static_cast<std::size_t>(tiles), 1, 1}, {TILE_PX, 1, 1}};
    raycast_kernel_.launch(size, tiles_, tile_near_, tile_far_, volume.table(), volume.pool(),
                           volume.params(), intrinsics_, shape_, to_pose(T_g_c), prediction.depth_m,
                           prediction.normals_c);
}

}  // namespace touchstone
