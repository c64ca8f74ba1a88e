#include "pipeline/volumetric_integration.hpp"

#include "pipeline/kernel_program.hpp"

namespace touchstone {

BrickLayers all_layers(const TsdfVolume& volume) { return {0, volume.params().bricks_per_side}; }

BrickLayers layer_share(const TsdfVolume& volume, int index, int parts) {
    const int side = volume.params().bricks_per_side;
    const int first = side * index / parts;
    return {first, side * (index + 1) / parts - first};
}

BrickLayers interleaved_layers(const TsdfVolume& volume, int index, int parts) {
    return {index, (volume.params().bricks_per_side - index + parts - 1) / parts, parts};
}

VolumetricIntegration::VolumetricIntegration(const Device& device, const Intrinsics& intrinsics,
                                             const SensorNoise& noise)
    : device_(&device),
      intrinsics_(intrinsics),
      noise_(noise),
      shape_(make_map_shape(intrinsics)),
      selection_(load_kernel_program(device, "brick_selection.cl")),
      integration_(load_kernel_program(device, "listing_2_tsdf_integration.cl")),
      depth_tile_ranges_(selection_.kernel("depth_tile_ranges")),
      classify_bricks_(selection_.kernel("classify_bricks")),
      integrate_(integration_.kernel("integrate")),
      integrate_moving_(integration_.kernel("integrate_moving")),
      tile_ranges_m_(device, 2 * static_cast<std::size_t>(tile_count(shape_))) {}

const std::vector<int>& VolumetricIntegration::integrate(TsdfVolume& volume, const Buffer<float>& depth_m,
                                                         const Buffer<std::uint8_t>& sample_weights,
                                                         const RigidTransform& T_g_c,
                                                         const BrickLayers& layers) {
    const Pose T_c_g = to_pose(T_g_c.inverse());
    updated_bricks_.clear();
    if (layers.count <= 0) return updated_bricks_;
    classify(volume, depth_m, sample_weights, T_c_g, layers);
    select_bricks(volume, layers);
    if (updated_bricks_.empty()) return updated_bricks_;
    const LaunchSize size{{BRICK_VOX * updated_bricks_.size(), 1, 1}, {BRICK_VOX, 1, 1}};
    integrate_.launch(size, slots_, volume.brick_of_slot(), volume.pool(), volume.has_inside(), depth_m,
                      sample_weights, volume.params(), noise_, intrinsics_, shape_, T_c_g);
    return updated_bricks_;
}

void VolumetricIntegration::integrate_moving(TsdfVolume& volume, const Buffer<float>& depth_m,
                                             const Buffer<std::uint8_t>& surface_weights,
                                             const Buffer<std::uint8_t>& sample_weights,
                                             const RigidTransform& T_g_c, const BrickLayers& layers,
                                             const AdaptiveWeightParams& adaptive) {
    const Pose T_c_g = to_pose(T_g_c.inverse());
    updated_bricks_.clear();
    if (layers.count > 0) {
        classify(volume, depth_m, surface_weights, T_c_g, layers);
        select_bricks(volume, layers);
    }
    if (volume.bricks_in_use() == 0) return;
    volume.has_inside().fill(0);
    const LaunchSize size{{64 * static_cast<std::size_t>(volume.bricks_in_use()), 1, 1}, {64, 1, 1}};
    integrate_moving_.launch(size, volume.brick_of_slot(), volume.pool(), volume.has_inside(), depth_m,
                             sample_weights, volume.params(), adaptive, noise_, intrinsics_, shape_, T_c_g);
}

void VolumetricIntegration::classify(const TsdfVolume& volume, const Buffer<float>& depth_m,
                                     const Buffer<std::uint8_t>& sample_weights, const Pose& T_c_g,
                                     const BrickLayers& layers) {
    const auto tiles_x = static_cast<std::size_t>(tiles_per_row(shape_));
    const auto tiles_y = static_cast<std::size_t>(shape_.rows_px / TILE_PX);
    depth_tile_ranges_.launch({{tiles_x, tiles_y, 1}, {1, 1, 1}}, depth_m, sample_weights, tile_ranges_m_,
                              shape_);
    const auto side = static_cast<std::size_t>(volume.params().bricks_per_side);
    const auto count = static_cast<std::size_t>(layers.count);
    if (classes_.size() < side * count * side) classes_ = Buffer<std::uint8_t>(*device_, side * count * side);
    classify_bricks_.launch({{ceil_div(side, 8), count, round_up(side, 8)}, {1, 1, 8}}, depth_m,
                            sample_weights, tile_ranges_m_, classes_, layers.first, layers.count, layers.step,
                            volume.params(), intrinsics_, shape_, T_c_g);
}

void VolumetricIntegration::select_bricks(TsdfVolume& volume, const BrickLayers& layers) {
    const int side = volume.params().bricks_per_side;
    std::vector<int> near_surface;
    {
        const auto classes = classes_.map_read();
        std::size_t at = 0;
        for (int z = 0; z < side; ++z) {
            for (int layer = 0; layer < layers.count; ++layer) {
                const int y = layers.first + layer * layers.step;
                for (int x = 0; x < side; ++x, ++at) {
                    if (classes[at] == BRICK_HIDDEN) continue;
                    const int brick = (z * side + y) * side + x;
                    if (volume.slot(brick) >= 0)
                        updated_bricks_.push_back(brick);
                    else if (classes[at] == BRICK_NEAR_SURFACE)
                        near_surface.push_back(brick);
                }
            }
        }
    }
    volume.allocate(near_surface);
    for (const int brick : near_surface) {
        if (volume.slot(brick) >= 0) updated_bricks_.push_back(brick);
    }
    if (updated_bricks_.empty()) return;
    if (slots_.size() < updated_bricks_.size()) slots_ = Buffer<int>(*device_, 2 * updated_bricks_.size());
    const auto slots = slots_.map_write();
    for (std::size_t i = 0; i < updated_bricks_.size(); ++i) slots[i] = volume.slot(updated_bricks_[i]);
}

}  // namespace touchstone
