#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/tsdf_volume.hpp"

namespace touchstone {

/// A volume on the host: what meshes are made of and what scans are saved as. Equal volumes give equal
/// snapshots, whatever the order in which their bricks came to be.
struct VolumeSnapshot {
    VolumeConfig config;
    std::vector<int> bricks;           ///< index in the cube's table, (z n + y) n + x, ascending
    std::vector<std::int32_t> voxels;  ///< BRICK_VOXELS of each brick, x fastest; format in shared_types.h
    std::vector<int> color_bricks;     ///< the bricks that have colours, ascending; a subset of `bricks`
    std::vector<std::uint32_t>
        colors;  ///< BRICK_VOXELS of each: red | green << 8 | blue << 16 | weight << 24
};

/// Waits for the device.
VolumeSnapshot take_snapshot(const TsdfVolume& volume);

/// A volume that gives this snapshot again. Throws Error{configuration} where the size is not allowed,
/// Error{bad_data} where the bricks do not fit it or its pool limit.
TsdfVolume restore_volume(const Device& device, const VolumeSnapshot& snapshot);

}  // namespace touchstone
