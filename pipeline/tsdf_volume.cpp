#include "pipeline/tsdf_volume.hpp"

#include <algorithm>

#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr std::size_t first_capacity_bricks = 4096;

/// Known, and at or behind a surface.
bool is_inside(std::int32_t voxel) {
    return ((voxel >> 16) & 0xff) > 0 && static_cast<std::int16_t>(voxel & 0xffff) <= 0;
}

}  // namespace

VolumeParams make_volume_params(const VolumeConfig& config) {
    VolumeParams params{};
    params.voxel_m = config.side_m / static_cast<float>(config.size_vox);
    params.max_truncation_m = std::max(config.max_truncation_vox * params.voxel_m, config.min_truncation_m);
    params.min_truncation_m = std::max(config.min_truncation_vox * params.voxel_m, config.min_truncation_m);
    params.size_vox = config.size_vox;
    params.bricks_per_side = config.size_vox / BRICK_VOX;
    params.max_weight = config.max_weight;
    return params;
}

TsdfVolume::TsdfVolume(const Device& device, const VolumeConfig& config)
    : device_(&device), config_(config), params_(make_volume_params(config)) {
    if (config.size_vox < BRICK_VOX || config.size_vox % BRICK_VOX != 0 || config.size_vox > 2048) {
        throw Error(ExitStatus::configuration, "volume.size_vox must be a multiple of 8 from 8 to 2048");
    }
    const auto side = static_cast<std::size_t>(params_.bricks_per_side);
    host_table_.assign(side * side * side, -1);
    table_ = Buffer<int>(device, host_table_);
    reserve(first_capacity_bricks);
}

std::size_t TsdfVolume::memory_bytes() const {
    const std::size_t color_bytes = colors_ ? colors_->memory_bytes() : 0;
    return (host_table_.size() + capacity_ * (BRICK_VOXELS + 1)) * sizeof(int) + color_bytes;
}

void TsdfVolume::allocate(std::span<const int> bricks) {
    const std::size_t first_new = slots_.size();
    for (const int brick : bricks) {
        int& slot = host_table_[static_cast<std::size_t>(brick)];
        if (slot >= 0) continue;
        if (slots_.size() >= static_cast<std::size_t>(config_.max_bricks)) {
            if (!full_) log_warning("volume full: {} bricks in use, no new surface is kept", slots_.size());
            full_ = true;
            break;
        }
        slot = static_cast<int>(slots_.size());
        slots_.push_back(brick);
    }
    if (slots_.size() == first_new) return;
    reserve(slots_.size());
    const auto table = table_.map_update();
    const auto bricks_of_slots = brick_of_slot_.map_update();
    for (std::size_t slot = first_new; slot < slots_.size(); ++slot) {
        table[static_cast<std::size_t>(slots_[slot])] = static_cast<int>(slot);
        bricks_of_slots[slot] = slots_[slot];
    }
}

ColorPool& TsdfVolume::keep_colors() {
    if (!colors_) colors_.emplace(*device_, host_table_.size());
    return *colors_;
}

int TsdfVolume::shifted(int brick, const Eigen::Vector3i& shift) const {
    const int n = params_.bricks_per_side;
    const Eigen::Array3i to = Eigen::Array3i(brick % n, brick / n % n, brick / (n * n)) + shift.array();
    const bool inside = (to >= 0).all() && (to < n).all();
    return inside ? (to.z() * n + to.y()) * n + to.x() : -1;
}

void TsdfVolume::rearrange(std::span<const std::uint8_t> kept, const Eigen::Vector3i& shift) {
    const auto pool = pool_.map_update();
    const auto table = table_.map_update();
    const auto bricks_of_slots = brick_of_slot_.map_update();
    const auto has_inside = has_inside_.map_update();
    for (const int brick : slots_) {
        host_table_[static_cast<std::size_t>(brick)] = -1;
        table[static_cast<std::size_t>(brick)] = -1;
    }
    const std::size_t before = slots_.size();
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < before; ++slot) {
        const int to = kept[slot] != 0 ? shifted(slots_[slot], shift) : -1;
        if (to < 0) continue;
        if (slot != count)
            std::ranges::copy(pool.values().subspan(slot * BRICK_VOXELS, BRICK_VOXELS),
                              pool.values().begin() + static_cast<std::ptrdiff_t>(count * BRICK_VOXELS));
        has_inside[count] = has_inside[slot];
        bricks_of_slots[count] = slots_[count] = to;
        host_table_[static_cast<std::size_t>(to)] = static_cast<int>(count);
        table[static_cast<std::size_t>(to)] = static_cast<int>(count);
        ++count;
    }
    slots_.resize(count);
    std::ranges::fill(pool.values().subspan(count * BRICK_VOXELS, (before - count) * BRICK_VOXELS), 0);
    std::ranges::fill(has_inside.values().subspan(count, before - count), std::uint8_t{0});
}

void TsdfVolume::write(std::span<const std::int32_t> voxels) {
    if (voxels.size() != slots_.size() * BRICK_VOXELS)
        throw Error(ExitStatus::bad_data, "a volume is given voxels for another number of bricks");
    pool_.write(voxels);
    const auto has_inside = has_inside_.map_update();
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
        const auto brick = voxels.subspan(slot * BRICK_VOXELS, BRICK_VOXELS);
        has_inside[slot] = std::ranges::any_of(brick, is_inside) ? 1 : 0;
    }
}

void TsdfVolume::write(std::span<const int> slots, std::span<const std::int32_t> voxels) {
    const auto pool = pool_.map_update();
    const auto has_inside = has_inside_.map_update();
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const auto brick = voxels.subspan(i * BRICK_VOXELS, BRICK_VOXELS);
        const auto slot = static_cast<std::size_t>(slots[i]);
        std::ranges::copy(brick, pool.values().subspan(slot * BRICK_VOXELS).begin());
        has_inside[slot] = std::ranges::any_of(brick, is_inside) ? 1 : 0;
    }
}

void TsdfVolume::reserve(std::size_t slots) {
    if (slots <= capacity_) return;
    const auto limit = static_cast<std::size_t>(config_.max_bricks);
    const std::size_t capacity =
        std::min(limit, std::max({slots, capacity_ + capacity_ / 4, first_capacity_bricks}));
    Buffer<int> pool(*device_, capacity * BRICK_VOXELS), brick_of_slot(*device_, capacity);
    Buffer<std::uint8_t> has_inside(*device_, capacity);
    pool.fill(0);
    has_inside.fill(0);
    if (capacity_ > 0) {
        pool.copy_from(pool_);
        brick_of_slot.copy_from(brick_of_slot_);
        has_inside.copy_from(has_inside_);
    }
    pool_ = std::move(pool);
    brick_of_slot_ = std::move(brick_of_slot);
    has_inside_ = std::move(has_inside);
    capacity_ = capacity;
}

}  // namespace touchstone
