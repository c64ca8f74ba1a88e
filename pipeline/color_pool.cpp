#include "pipeline/color_pool.hpp"

#include <algorithm>

namespace touchstone {

namespace {

constexpr std::size_t first_capacity_bricks = 1024;

}  // namespace

ColorPool::ColorPool(const Device& device, std::size_t brick_count)
    : device_(&device), slot_of_brick_(brick_count, -1) {
    reserve(first_capacity_bricks);
}

void ColorPool::allocate(std::span<const int> bricks) {
    for (const int brick : bricks) {
        int& slot = slot_of_brick_[static_cast<std::size_t>(brick)];
        if (slot >= 0) continue;
        slot = static_cast<int>(brick_of_slot_.size());
        brick_of_slot_.push_back(brick);
    }
    reserve(brick_of_slot_.size());
}

void ColorPool::restore(std::span<const int> bricks, std::span<const std::uint32_t> colors) {
    allocate(bricks);
    colors_.write(colors);
}

std::size_t ColorPool::memory_bytes() const {
    return slot_of_brick_.size() * sizeof(int) + capacity_ * BRICK_VOXELS * sizeof(std::uint32_t);
}

void ColorPool::reserve(std::size_t slots) {
    if (slots <= capacity_) return;
    const std::size_t capacity = std::max({slots, capacity_ + capacity_ / 4, first_capacity_bricks});
    Buffer<std::uint32_t> colors(*device_, capacity * BRICK_VOXELS);
    colors.fill(0);
    if (capacity_ > 0) colors.copy_from(colors_);
    colors_ = std::move(colors);
    capacity_ = capacity;
}

}  // namespace touchstone
