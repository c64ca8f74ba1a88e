#include "pipeline/background_model.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "pipeline/kernel_program.hpp"

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
            const Eigen::Vector3f point_c_m = back_project(k, x, y, z);
            for (std::size_t axis = 0; axis < 3; ++axis)
                points[axis].push_back(point_c_m[static_cast<Eigen::Index>(axis)]);
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
    : device_(&device),
      config_(config),
      intrinsics_(intrinsics),
      placement_(placement),
      volume_(std::move(volume)),
      weighting_(device, config.weights, intrinsics),
      integration_(device, intrinsics, config.weights.noise),
      raycasting_(device, intrinsics),
      resting_(device, config.rest, config.weights.noise, make_map_shape(intrinsics)),
      prediction_(device, make_map_shape(intrinsics)),
      settled_(device, config.objects, intrinsics),
      program_(load_kernel_program(device, "foreground_segmentation.cl")),
      join_masks_(program_.kernel("join_masks")),
      left_out_(device, map_pixels(prediction_.shape)),
      joined_(device, map_pixels(prediction_.shape)) {
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

void BackgroundModel::scan_anew(const LiveMaps& mean, std::span<const std::uint8_t> frames) {
    volume_ = TsdfVolume(*device_, volume_.config());
    resting_.restart();
    std::vector<std::uint8_t> weights = weighting_.weigh(mean).read();
    for (std::size_t at = 0; at < weights.size(); ++at)
        weights[at] = weights[at] != 0 ? frames[at] : std::uint8_t{0};
    joined_.write(weights);
    integration_.integrate(volume_, mean.depth_m, joined_, placement_.T_g_c, all_layers(volume_));
    raycasting_.raycast(volume_, placement_.T_g_c, prediction_);
}

void BackgroundModel::follow(const LiveMaps& live, const Buffer<std::uint8_t>& mask,
                             std::span<const std::uint8_t> rgb) {
    const BrickLayers share = layer_share(volume_, next_part_, config_.refresh_parts);
    next_part_ = (next_part_ + 1) % config_.refresh_parts;
    Buffer<std::uint8_t>& weights = weighting_.weigh(live, all_left_out(mask));
    if (!rgb.empty()) colour(live, rgb, weights);
    resting_.leave_out(live, prediction_, weights);
    const std::vector<int>& changed =
        integration_.integrate(volume_, live.depth_m, weights, placement_.T_g_c, share);
    raycasting_.refresh(volume_, placement_.T_g_c, changed, prediction_);
    settled_.lay_over(prediction_);
}

/// A still surface needs few colour pictures, and each costs time.
void BackgroundModel::colour(const LiveMaps& live, std::span<const std::uint8_t> rgb,
                             const Buffer<std::uint8_t>& weights) {
    if (frames_to_color_-- > 0) return;
    frames_to_color_ = config_.color_interval - 1;
    if (!color_) color_.emplace(*device_, config_.color, intrinsics_);
    std::vector<int> part;
    {
        const auto bricks =
            volume_.brick_of_slot().map_read(static_cast<std::size_t>(volume_.bricks_in_use()));
        for (auto slot = static_cast<std::size_t>(next_color_part_); slot < bricks.size();
             slot += static_cast<std::size_t>(config_.refresh_parts))
            part.push_back(bricks[slot]);
    }
    next_color_part_ = (next_color_part_ + 1) % config_.refresh_parts;
    color_->integrate(volume_, live, rgb, weights, placement_.T_g_c, part);
}

void BackgroundModel::move_camera(const RigidTransform& T_g_c) {
    placement_.T_g_c = T_g_c;
    resting_.restart();
    raycasting_.raycast(volume_, T_g_c, prediction_);
    settled_.move_camera(T_g_c);
    settled_.lay_over(prediction_);
    leave_out({});
}

void BackgroundModel::settle(const DepthPatch& object) {
    settled_.add(object, volume_.config(), placement_.T_g_c);
    settled_.lay_over(prediction_);
}

int BackgroundModel::drop_taken(const ObjectFrame& frame) {
    const std::vector<PixelRegion> boxes = settled_.drop_taken(frame);
    for (const PixelRegion& box : boxes) predict_again(box);
    return static_cast<int>(boxes.size());
}

VolumeSnapshot BackgroundModel::cut_out(const UncoveredSurface& uncovered, const ObjectFrame& frame) {
    VolumeSnapshot object = touchstone::cut_out(volume_, uncovered, frame, placement_.T_g_c);
    const MapShape& shape = prediction_.shape;
    std::vector<float> depth_m(map_pixels(shape), 0.0f);
    std::vector<std::uint8_t> weights(map_pixels(shape), 0);
    const PixelRegion& box = uncovered.mean.box;
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            if (!uncovered.is_inside(x, y)) continue;
            depth_m[map_index(shape, x, y)] = uncovered.mean.at(x, y);
            weights[map_index(shape, x, y)] = uncovered.mean.samples[uncovered.mean.index(x, y)];
        }
    }
    joined_.write(weights);
    integration_.integrate(volume_, Buffer<float>(*device_, depth_m), joined_, placement_.T_g_c,
                           all_layers(volume_));
    predict_again(box);
    return object;
}

/// The tiles of a box, from the volume as it is.
void BackgroundModel::predict_again(const PixelRegion& box) {
    std::vector<int> tiles;
    for (int y = box.y0 / TILE_PX; y * TILE_PX < box.y1; ++y) {
        for (int x = box.x0 / TILE_PX; x * TILE_PX < box.x1; ++x)
            tiles.push_back(y * tiles_per_row(prediction_.shape) + x);
    }
    raycasting_.raycast_tiles(volume_, placement_.T_g_c, tiles, prediction_);
    settled_.lay_over(prediction_);
}

void BackgroundModel::leave_out(std::span<const UncoveredSurface> uncovered) {
    leaves_out_ = !settled_.empty() || !uncovered.empty();
    if (!leaves_out_) return;
    std::vector<std::uint8_t> map = settled_.cover();
    for (const UncoveredSurface& surface : uncovered) surface.mark(map, prediction_.shape);
    left_out_.write(map);
}

const Buffer<std::uint8_t>& BackgroundModel::all_left_out(const Buffer<std::uint8_t>& mask) {
    if (!leaves_out_) return mask;
    join_masks_.launch(eight_pixels_each(prediction_.shape), mask, left_out_, joined_, prediction_.shape);
    return joined_;
}

}  // namespace touchstone
