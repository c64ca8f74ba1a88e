#include "pipeline/background_model.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace touchstone {

namespace {

constexpr float min_side_m = 1.0f, max_side_m = 5.0f;
constexpr std::size_t min_points = 1000;

/// Coordinates of the valid points of a picture, axis by axis, every other row and column.
std::array<std::vector<float>, 3> seen_points_c_m(const DepthView& view, float max_depth_m) {
    std::array<std::vector<float>, 3> points;
    const Intrinsics& k = view.intrinsics;
    for (int y = 0; y < k.height_px; y += 2) {
        for (int x = 0; x < k.width_px; x += 2) {
            const auto pixel = static_cast<std::size_t>(y * k.width_px + x);
            const float z = static_cast<float>(view.depth_mm[pixel]) * 0.001f;
            if (z <= 0.0f || z > max_depth_m) continue;
            points[0].push_back((static_cast<float>(x) - k.cx_px) / k.fx_px * z);
            points[1].push_back((static_cast<float>(y) - k.cy_px) / k.fy_px * z);
            points[2].push_back(z);
        }
    }
    return points;
}

float quantile(std::vector<float>& values, double share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

VolumeConfig with_side(VolumeConfig config, float side_m) {
    config.side_m = side_m;
    return config;
}

}  // namespace

std::optional<VolumePlacement> fit_volume(const DepthView& view, float max_depth_m) {
    std::array<std::vector<float>, 3> points = seen_points_c_m(view, max_depth_m);
    if (points[0].size() < min_points / 4) return std::nullopt;
    Eigen::Vector3f low, high;
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = quantile(points[static_cast<std::size_t>(axis)], 0.005);
        high[axis] = quantile(points[static_cast<std::size_t>(axis)], 0.995);
    }
    VolumePlacement placement;
    placement.side_m = std::clamp(1.1f * (high - low).maxCoeff(), min_side_m, max_side_m);
    Eigen::Vector3f center = 0.5f * (low + high);
    center.z() = std::min(center.z(), low.z() + 0.45f * placement.side_m);
    placement.T_g_c.translation() = Eigen::Vector3f::Constant(0.5f * placement.side_m) - center;
    return placement;
}

std::optional<VolumePlacement> place_volume(const DepthView& view, const BackgroundConfig& config) {
    std::optional<VolumePlacement> placement = fit_volume(view, config.max_volume_depth_m);
    if (!placement || config.fit_side) return placement;
    placement->T_g_c.translation().array() += 0.5f * (config.volume.side_m - placement->side_m);
    placement->side_m = config.volume.side_m;
    return placement;
}

BackgroundModel::BackgroundModel(const Device& device, const BackgroundConfig& config,
                                 const Intrinsics& intrinsics, const VolumePlacement& placement,
                                 TsdfVolume volume)
    : config_(config),
      placement_(placement),
      volume_(std::move(volume)),
      weighting_(device, config.weights, intrinsics),
      integration_(device, intrinsics, config.weights.noise),
      raycasting_(device, intrinsics),
      prediction_(device, make_map_shape(intrinsics)) {
    prediction_.depth_m.fill(0.0f);
    prediction_.normals_c.fill(0.0f);
}

BackgroundModel::BackgroundModel(const Device& device, const BackgroundConfig& config,
                                 const Intrinsics& intrinsics, const VolumePlacement& placement)
    : BackgroundModel(device, config, intrinsics, placement,
                      TsdfVolume(device, with_side(config.volume, placement.side_m))) {}

BackgroundModel::BackgroundModel(const Device& device, const BackgroundConfig& config,
                                 const Intrinsics& intrinsics, const VolumeSnapshot& saved,
                                 const RigidTransform& T_g_c)
    : BackgroundModel(device, config, intrinsics, {saved.config.side_m, T_g_c},
                      restore_volume(device, saved)) {
    move_camera(T_g_c);
}

void BackgroundModel::scan(const LiveMaps& live) {
    integration_.integrate(volume_, live.depth_m, weighting_.weigh(live), placement_.T_g_c,
                           all_layers(volume_));
    raycasting_.raycast(volume_, placement_.T_g_c, prediction_);
}

void BackgroundModel::follow(const LiveMaps& live, const Buffer<std::uint8_t>& mask) {
    const BrickLayers share = layer_share(volume_, next_part_, config_.refresh_parts);
    next_part_ = (next_part_ + 1) % config_.refresh_parts;
    const std::vector<int>& changed =
        integration_.integrate(volume_, live.depth_m, weighting_.weigh(live, mask), placement_.T_g_c, share);
    raycasting_.refresh(volume_, placement_.T_g_c, changed, prediction_);
}

void BackgroundModel::move_camera(const RigidTransform& T_g_c) {
    placement_.T_g_c = T_g_c;
    raycasting_.raycast(volume_, T_g_c, prediction_);
}

}  // namespace touchstone
