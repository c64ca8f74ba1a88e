#include "pipeline/volume_snapshot.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

/// Slots in the order of their bricks.
std::vector<std::size_t> slots_by_brick(std::span<const int> bricks) {
    std::vector<std::size_t> slots(bricks.size());
    std::iota(slots.begin(), slots.end(), std::size_t{0});
    std::ranges::sort(slots, {}, [&](std::size_t slot) { return bricks[slot]; });
    return slots;
}

/// Ascending and without doubles.
bool in_order(std::span<const int> bricks) {
    return std::ranges::adjacent_find(bricks, std::greater_equal{}) == bricks.end();
}

void check(const VolumeSnapshot& snapshot) {
    const std::size_t side = static_cast<std::size_t>(snapshot.config.size_vox / BRICK_VOX);
    const bool inside =
        snapshot.bricks.empty() || (snapshot.bricks.front() >= 0 &&
                                    static_cast<std::size_t>(snapshot.bricks.back()) < side * side * side);
    if (!in_order(snapshot.bricks) || !inside ||
        snapshot.voxels.size() != snapshot.bricks.size() * BRICK_VOXELS)
        throw Error(ExitStatus::bad_data, "the bricks of the volume do not fit its cube");
    if (snapshot.bricks.size() > static_cast<std::size_t>(snapshot.config.max_bricks))
        throw Error(ExitStatus::bad_data, "the volume has more bricks than its pool allows");
    if (!in_order(snapshot.color_bricks) || !std::ranges::includes(snapshot.bricks, snapshot.color_bricks) ||
        snapshot.colors.size() != snapshot.color_bricks.size() * BRICK_VOXELS)
        throw Error(ExitStatus::bad_data, "the colours of the volume do not fit its bricks");
}

void take_colors(const ColorPool& pool, VolumeSnapshot& snapshot) {
    if (pool.bricks().empty()) return;
    const auto mapped = pool.colors().map_read(pool.bricks().size() * BRICK_VOXELS);
    for (const std::size_t slot : slots_by_brick(pool.bricks())) {
        snapshot.color_bricks.push_back(pool.bricks()[slot]);
        const auto colors = mapped.values().subspan(slot * BRICK_VOXELS, BRICK_VOXELS);
        snapshot.colors.insert(snapshot.colors.end(), colors.begin(), colors.end());
    }
}

}  // namespace

VolumeSnapshot take_snapshot(const TsdfVolume& volume) {
    VolumeSnapshot snapshot;
    snapshot.config = volume.config();
    if (volume.bricks_in_use() == 0) return snapshot;
    const auto bricks = volume.brick_of_slot().map_read(static_cast<std::size_t>(volume.bricks_in_use()));
    const auto pool = volume.pool().map_read(bricks.size() * BRICK_VOXELS);
    snapshot.voxels.reserve(bricks.size() * BRICK_VOXELS);
    for (const std::size_t slot : slots_by_brick(bricks.values())) {
        snapshot.bricks.push_back(bricks[slot]);
        const auto voxels = pool.values().subspan(slot * BRICK_VOXELS, BRICK_VOXELS);
        snapshot.voxels.insert(snapshot.voxels.end(), voxels.begin(), voxels.end());
    }
    if (volume.colors() != nullptr) take_colors(*volume.colors(), snapshot);
    return snapshot;
}

TsdfVolume restore_volume(const Device& device, const VolumeSnapshot& snapshot) {
    TsdfVolume volume(device, snapshot.config);
    check(snapshot);
    volume.allocate(snapshot.bricks);
    volume.write(snapshot.voxels);
    if (!snapshot.color_bricks.empty()) volume.keep_colors().restore(snapshot.color_bricks, snapshot.colors);
    return volume;
}

}  // namespace touchstone
