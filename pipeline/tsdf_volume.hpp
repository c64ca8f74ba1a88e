#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/shared_types.h"
#include "pipeline/color_pool.hpp"
#include "platform/opencl/buffer.hpp"

namespace touchstone {

struct VolumeConfig {
    int size_vox = 512;               ///< voxels along a side, a multiple of 8
    float side_m = 1.5f;              ///< of the cube
    float max_truncation_vox = 6.0f;  ///< in front of the surface
    float min_truncation_vox = 4.0f;  ///< behind it; farther behind stays unknown
    float min_truncation_m = 0.012f;  ///< both truncations are at least this, whatever the voxel
    int max_weight = 128;             ///< 1..255
    int max_bricks = 65536;           ///< pool limit; 2 KiB each
};

/// Scalars of a volume as kernels take them.
VolumeParams make_volume_params(const VolumeConfig& config);

/// A TSDF over a cube as 8x8x8 bricks: a flat table (brick -> slot in the pool, -1 absent) and a pool that
/// grows to a limit. The global frame has its origin in the cube's corner. Voxel format: shared_types.h.
class TsdfVolume {
  public:
    TsdfVolume(const Device& device, const VolumeConfig& config);

    const VolumeConfig& config() const { return config_; }
    const VolumeParams& params() const { return params_; }
    const Buffer<int>& table() const { return table_; }
    const Buffer<int>& pool() const { return pool_; }
    /// Table index of each slot in use.
    const Buffer<int>& brick_of_slot() const { return brick_of_slot_; }
    /// Of each slot in use: not 0 once a voxel of it was behind a surface. Other bricks hold no zero
    /// crossing's far end.
    const Buffer<std::uint8_t>& has_inside() const { return has_inside_; }
    Buffer<std::uint8_t>& has_inside() { return has_inside_; }
    int bricks_in_use() const { return static_cast<int>(slots_.size()); }
    std::size_t brick_count() const { return host_table_.size(); }
    std::size_t memory_bytes() const;
    /// True from the moment a brick could not be had because of the limit.
    bool is_full() const { return full_; }

    /// Slot of a brick, -1 when absent.
    int slot(int brick) const { return host_table_[static_cast<std::size_t>(brick)]; }
    /// Gives each of the bricks a slot of unknown voxels where it has none and the limit allows.
    void allocate(std::span<const int> bricks);
    /// Colours of the bricks that hold a surface; null until keep_colors().
    const ColorPool* colors() const { return colors_ ? &*colors_ : nullptr; }
    /// From now on there are colours: 2 KiB more for each brick that holds a surface.
    ColorPool& keep_colors();
    /// Every brick moves by `shift` bricks; those that leave the cube, and those whose slot is 0 in `kept`,
    /// are forgotten. Slots are numbered anew. For volumes without colours.
    void rearrange(std::span<const std::uint8_t> kept, const Eigen::Vector3i& shift);
    /// Overwrites the voxels of all slots in use, BRICK_VOXELS each, in slot order.
    void write(std::span<const std::int32_t> voxels);
    /// Overwrites the voxels of some slots, BRICK_VOXELS each.
    void write(std::span<const int> slots, std::span<const std::int32_t> voxels);

  private:
    void reserve(std::size_t slots);
    /// Table index after a shift, -1 outside the cube.
    int shifted(int brick, const Eigen::Vector3i& shift) const;

    const Device* device_;
    VolumeConfig config_;
    VolumeParams params_;
    Buffer<int> table_, pool_, brick_of_slot_;
    Buffer<std::uint8_t> has_inside_;
    std::vector<int> host_table_;
    std::vector<int> slots_;
    std::optional<ColorPool> colors_;
    std::size_t capacity_ = 0;
    bool full_ = false;
};

}  // namespace touchstone
