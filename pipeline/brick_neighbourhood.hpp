#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/volume_snapshot.hpp"

namespace touchstone {

/// TSDF in steps of max_truncation / TSDF_SCALE.
inline int voxel_tsdf(std::int32_t voxel) { return static_cast<std::int16_t>(voxel & 0xffff); }
inline int voxel_weight(std::int32_t voxel) { return voxel >> 16 & 0xff; }

/// Where each brick of a cube's table is in a list of bricks; -1 where it is not.
class BrickLookup {
  public:
    BrickLookup(const std::vector<int>& bricks, int bricks_per_side);

    int bricks_per_side() const { return side_; }
    /// -1 outside the cube as well.
    int slot(const std::array<int, 3>& brick) const;

  private:
    int side_;
    std::vector<int> slots_;
};

/// Place of a brick in the cube, in bricks.
inline std::array<int, 3> brick_place(int brick, int bricks_per_side) {
    return {brick % bricks_per_side, brick / bricks_per_side % bricks_per_side,
            brick / bricks_per_side / bricks_per_side};
}

/// A brick and the 26 around it. Places are in voxels from the brick's corner, -8 to 15.
class BrickNeighbourhood {
  public:
    BrickNeighbourhood(const BrickLookup& lookup, const std::array<int, 3>& brick);

    /// Slot of the brick that this voxel is in, -1 when absent.
    int slot(int x, int y, int z) const {
        return slots_[static_cast<std::size_t>(((z >> 3) * 3 + (y >> 3)) * 3 + (x >> 3) + 13)];
    }
    /// Place of the voxel in the arrays of a snapshot, `absent` when its brick is.
    std::size_t index(int x, int y, int z) const {
        const int in_slot = slot(x, y, z);
        if (in_slot < 0) return absent;
        return static_cast<std::size_t>(in_slot) * BRICK_VOXELS +
               static_cast<std::size_t>((z & 7) << 6 | (y & 7) << 3 | (x & 7));
    }

    static constexpr std::size_t absent = ~std::size_t{0};

  private:
    std::array<int, 27> slots_{};
};

}  // namespace touchstone
