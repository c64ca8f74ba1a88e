#include "pipeline/moving_volume.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/pose_solver.hpp"

namespace touchstone {

namespace {

float brick_m(const TsdfVolume& volume) { return BRICK_VOX * volume.params().voxel_m; }

float side_m(const TsdfVolume& volume) {
    return static_cast<float>(volume.params().size_vox) * volume.params().voxel_m;
}

}  // namespace

MovingVolume::MovingVolume(const Device& device, const VolumeConfig& config, const MapShape& shape, int id,
                           const ComponentPoints& points)
    : prediction(device, shape), last_centre_c_m(points.centre_c_m), id_(id), volume_(device, config) {
    prediction.depth_m.fill(0.0f);
    prediction.normals_c.fill(0.0f);
    const Eigen::Vector3f middle_c_m = bounds_g_m(points).center();
    T_g_c_.translation() = Eigen::Vector3f::Constant(0.5f * config.side_m) - middle_c_m;
}

Eigen::AlignedBox3f MovingVolume::bounds_g_m(const ComponentPoints& points) const {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& point_c_m : points.at_c_m) box.extend(T_g_c_ * point_c_m);
    return box;
}

void MovingVolume::move(const RigidTransform& T_p_c) {
    T_g_c_ = orthonormal(T_g_c_ * T_p_c);
    last_step_T_p_c = T_p_c;
}

void MovingVolume::follow(const ComponentPoints& points) {
    const Eigen::AlignedBox3f box = bounds_g_m(points);
    const float margin_m = 2.0f * brick_m(volume_), far_m = side_m(volume_) - margin_m;
    if ((box.min().array() >= margin_m).all() && (box.max().array() <= far_m).all()) return;
    const Eigen::Array3f off_m = 0.5f * side_m(volume_) - box.center().array();
    const Eigen::Vector3i shift = (off_m / brick_m(volume_)).round().cast<int>().matrix();
    if (shift.isZero()) return;
    volume_.rearrange(std::vector<std::uint8_t>(static_cast<std::size_t>(volume_.bricks_in_use()), 1), shift);
    T_g_c_.pretranslate(brick_m(volume_) * shift.cast<float>());
}

void MovingVolume::prune() {
    const int n = volume_.params().bricks_per_side;
    const auto count = static_cast<std::size_t>(volume_.bricks_in_use());
    if (count == 0) return;
    std::vector<std::uint8_t> kept(count, 0);
    {
        const auto inside = volume_.has_inside().map_read(count);
        const auto bricks = volume_.brick_of_slot().map_read(count);
        for (std::size_t slot = 0; slot < count; ++slot) {
            if (inside[slot] == 0) continue;
            const int x = bricks[slot] % n, y = bricks[slot] / n % n, z = bricks[slot] / (n * n);
            for (int k = std::max(z - 1, 0); k <= std::min(z + 1, n - 1); ++k) {
                for (int j = std::max(y - 1, 0); j <= std::min(y + 1, n - 1); ++j) {
                    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, n - 1); ++i) {
                        const int near = volume_.slot((k * n + j) * n + i);
                        if (near >= 0) kept[static_cast<std::size_t>(near)] = 1;
                    }
                }
            }
        }
    }
    if (std::ranges::find(kept, 0) != kept.end()) volume_.rearrange(kept, Eigen::Vector3i::Zero());
}

void MovingVolume::clear() {
    volume_.rearrange(std::vector<std::uint8_t>(static_cast<std::size_t>(volume_.bricks_in_use()), 0),
                      Eigen::Vector3i::Zero());
    last_step_T_p_c = RigidTransform::Identity();
    frames = 0;
}

BrickLayers MovingVolume::layers(const ComponentPoints& points) const {
    const Eigen::AlignedBox3f box = bounds_g_m(points);
    const int last = volume_.params().bricks_per_side - 1;
    const auto layer = [&](float y_m) { return static_cast<int>(std::floor(y_m / brick_m(volume_))); };
    const int from = std::clamp(layer(box.min().y()) - 1, 0, last);
    const int to = std::clamp(layer(box.max().y()) + 1, 0, last);
    return {from, to - from + 1};
}

}  // namespace touchstone
