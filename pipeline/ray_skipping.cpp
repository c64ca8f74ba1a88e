#include "pipeline/ray_skipping.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace touchstone {

namespace {

struct Places {
    std::array<int, 3> low, high;  ///< the last is one of them
};

template <class F>
void for_each_brick(const Places& places, int side, F f) {
    for (int z = places.low[2]; z <= places.high[2]; ++z) {
        for (int y = places.low[1]; y <= places.high[1]; ++y) {
            for (int x = places.low[0]; x <= places.high[0]; ++x) f((z * side + y) * side + x);
        }
    }
}

std::array<int, 3> place_of(int brick, int side) {
    return {brick % side, brick / side % side, brick / side / side};
}

/// A brick and those around it, as far as the cube reaches.
Places beside(int brick, int side) {
    Places places{place_of(brick, side), place_of(brick, side)};
    for (int& low : places.low) low = std::max(low - 1, 0);
    for (int& high : places.high) high = std::min(high + 1, side - 1);
    return places;
}

Places group_of(int brick, int side) {
    Places places{place_of(brick, side), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        places.low[axis] -= places.low[axis] % SKIP_GROUP_BRICKS;
        places.high[axis] = std::min(places.low[axis] + SKIP_GROUP_BRICKS, side) - 1;
    }
    return places;
}

/// The group of a listed brick is looked into brick by brick.
void open_group(std::span<int> table, int brick, int side) {
    if (table[static_cast<std::size_t>(brick)] != SKIP_GROUP) return;
    for_each_brick(group_of(brick, side), side,
                   [&](int other) { table[static_cast<std::size_t>(other)] = SKIP_BRICK; });
}

}  // namespace

RaySkipping::RaySkipping(const Device& device) : device_(&device), table_(device, 1) { find_bounds(0); }

void RaySkipping::update(const TsdfVolume& volume) {
    if (table_.size() != volume.brick_count()) table_ = Buffer<int>(*device_, volume.brick_count());
    const auto slots = static_cast<std::size_t>(volume.bricks_in_use());
    inside_.clear();
    if (slots > 0) {
        const auto bricks = volume.brick_of_slot().map_read(slots);
        const auto has_inside = volume.has_inside().map_read(slots);
        for (std::size_t slot = 0; slot < slots; ++slot) {
            if (has_inside[slot] != 0) inside_.push_back(bricks[slot]);
        }
    }
    const int side = volume.params().bricks_per_side;
    find_bounds(side);
    const auto table = table_.map_write();
    std::ranges::fill(table.values(), SKIP_GROUP);
    for (const int brick : inside_) {
        for_each_brick(beside(brick, side), side, [&](int near) {
            open_group(table.values(), near, side);
            table[static_cast<std::size_t>(near)] = std::max(volume.slot(near), int{SKIP_BRICK});
        });
    }
}

void RaySkipping::find_bounds(int bricks_per_side) {
    Eigen::Array3i low = Eigen::Array3i::Constant(bricks_per_side), high = Eigen::Array3i::Zero();
    for (const int brick : inside_) {
        const Places places = beside(brick, bricks_per_side);
        low = low.min(Eigen::Map<const Eigen::Array3i>(places.low.data()));
        high = high.max(Eigen::Map<const Eigen::Array3i>(places.high.data()) + 1);
    }
    low_vox_ = (low * BRICK_VOX).cast<float>();
    high_vox_ = (high * BRICK_VOX).cast<float>();
}

}  // namespace touchstone
