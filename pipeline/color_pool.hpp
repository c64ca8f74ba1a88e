#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/shared_types.h"
#include "platform/opencl/buffer.hpp"

namespace touchstone {

/// Colours beside a volume's voxels, for the bricks that hold a surface only: BRICK_VOXELS of each, x
/// fastest, red | green << 8 | blue << 16 | weight << 24, weight 0 = none. Grows as needed.
class ColorPool {
  public:
    /// For a table of `brick_count` bricks.
    ColorPool(const Device& device, std::size_t brick_count);

    /// Gives each of the bricks (table indices) a slot without colours where it has none.
    void allocate(std::span<const int> bricks);
    /// Slot of a brick, -1 when it has no colours.
    int slot(int brick) const { return slot_of_brick_[static_cast<std::size_t>(brick)]; }
    /// The brick of each slot in use.
    std::span<const int> bricks() const { return brick_of_slot_; }
    const Buffer<std::uint32_t>& colors() const { return colors_; }
    /// An empty pool takes over these bricks and their colours.
    void restore(std::span<const int> bricks, std::span<const std::uint32_t> colors);
    std::size_t memory_bytes() const;

  private:
    void reserve(std::size_t slots);

    const Device* device_;
    std::vector<int> slot_of_brick_, brick_of_slot_;
    Buffer<std::uint32_t> colors_;
    std::size_t capacity_ = 0;
};

}  // namespace touchstone
