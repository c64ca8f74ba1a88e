#include "pipeline/foreground_model.hpp"

#include <algorithm>
#include <array>

#include "pipeline/kernel_program.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

constexpr int point_step_px = 4;
constexpr int prune_every_frames = 8;
constexpr int region_margin_px = 16;

/// Tiles that hold points, and those around them, row by row.
std::vector<int> tiles_around(const ComponentPoints& points, const MapShape& shape) {
    const int columns = tiles_per_row(shape), rows = shape.rows_px / TILE_PX;
    std::vector<char> flags(static_cast<std::size_t>(columns * rows), 0);
    for (const std::size_t pixel : points.map_index) {
        const int x = static_cast<int>(pixel) % shape.pitch_px / TILE_PX;
        const int y = static_cast<int>(pixel) / shape.pitch_px / TILE_PX;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rows - 1); ++j) {
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns - 1); ++i)
                flags[static_cast<std::size_t>(j * columns + i)] = 1;
        }
    }
    std::vector<int> tiles;
    for (std::size_t i = 0; i < flags.size(); ++i)
        if (flags[i] != 0) tiles.push_back(static_cast<int>(i));
    return tiles;
}

}  // namespace

bool reconstructs_foreground(const ForegroundModelConfig& config, const Device& device) {
    if (config.reconstruct == "on") return true;
    if (config.reconstruct == "off") return false;
    if (config.reconstruct == "auto") return !device.is_cpu();
    throw Error(ExitStatus::configuration, "foreground.reconstruct is auto, on or off");
}

ForegroundModel::ForegroundModel(const Device& device, const ForegroundModelConfig& config,
                                 const Intrinsics& intrinsics)
    : device_(&device),
      config_(config),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      weighting_(device, config.weights, intrinsics),
      tracking_(device, config.tracking, intrinsics),
      integration_(device, intrinsics, config.weights.noise),
      raycasting_(device, intrinsics),
      program_(load_kernel_program(device, "foreground_model.cl")),
      pick_component_(program_.kernel("pick_component")),
      drop_component_(program_.kernel("drop_component")),
      no_prediction_(program_.kernel("no_prediction")),
      take_live_(program_.kernel("take_live")),
      take_prediction_(program_.kernel("take_prediction")),
      own_weights_(device, map_pixels(shape_)),
      weights_with_free_(device, map_pixels(shape_)),
      others_(device, map_pixels(shape_)),
      source_(device, map_pixels(shape_)),
      surface_(device, shape_) {
    own_weights_.fill(0);
    weights_with_free_.fill(0);
    others_.fill(255);
    forget();
}

void ForegroundModel::forget() {
    volumes_.clear();
    source_.fill(FOREGROUND_NONE);
    surface_.depth_m.fill(0.0f);
    surface_.normals_c.fill(0.0f);
}

const SurfacePrediction& ForegroundModel::update(const LiveMaps& live, const Foreground& foreground) {
    const std::vector<Part> parts = large_parts(live, foreground);
    std::vector<int> component_of;
    assign(parts, component_of);
    take_live_.launch(eight_pixels_each(shape_), foreground.mask, live.filtered_m, live.normals_c,
                      surface_.depth_m, surface_.normals_c, source_, shape_);
    for (const Part& part : parts) sample_weights_ = &weighting_.weigh(live, part.points.region);
    for (std::size_t i = 0; i < volumes_.size(); ++i) {
        if (component_of[i] < 0) continue;
        const Part& part = parts[static_cast<std::size_t>(component_of[i])];
        follow(volumes_[i], part, live, foreground);
        take_prediction(volumes_[i], part, live, foreground);
    }
    device_->finish();
    return surface_;
}

std::vector<ForegroundModel::Part> ForegroundModel::large_parts(const LiveMaps& live,
                                                                const Foreground& foreground) const {
    std::vector<Part> parts;
    for (const ForegroundComponent& component : foreground.components) {
        if (component.pixels < config_.min_pixels) continue;
        ComponentPoints points =
            sample_component(foreground, live.filtered_m, component, intrinsics_, point_step_px);
        const PixelRegion region = grown(points.region, region_margin_px, shape_.width_px, shape_.height_px);
        parts.push_back({component, std::move(points), region});
    }
    std::ranges::sort(parts,
                      [](const Part& a, const Part& b) { return a.component.pixels > b.component.pixels; });
    return parts;
}

void ForegroundModel::assign(std::span<const Part> parts, std::vector<int>& component_of) {
    std::vector<ComponentPoints> points;
    for (const Part& part : parts) points.push_back(part.points);
    component_of = assign_components(volumes_, points, config_.reach_m);
    std::vector<bool> has_volume(parts.size(), false);
    std::vector<MovingVolume> kept;
    std::vector<int> kept_component_of;
    for (std::size_t i = 0; i < volumes_.size(); ++i) {
        const int component = component_of[i];
        volumes_[i].frames_missing = component >= 0 ? 0 : volumes_[i].frames_missing + 1;
        if (component >= 0) has_volume[static_cast<std::size_t>(component)] = true;
        if (volumes_[i].frames_missing > config_.missing_frames) continue;
        kept.push_back(std::move(volumes_[i]));
        kept_component_of.push_back(component);
    }
    volumes_ = std::move(kept);
    component_of = std::move(kept_component_of);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (has_volume[i] || volumes_.size() >= static_cast<std::size_t>(config_.most_volumes)) continue;
        volumes_.emplace_back(*device_, config_.volume, shape_, next_id_++, parts[i].points);
        component_of.push_back(static_cast<int>(i));
    }
}

void ForegroundModel::follow(MovingVolume& volume, const Part& part, const LiveMaps& live,
                             const Foreground& foreground) {
    const PixelRegion region = volume.region.empty() ? part.region : hull(part.region, volume.region);
    const LaunchSize size = eight_pixels_each(shape_, region);
    pick_component_.launch(size, foreground.labels, *sample_weights_, own_weights_, weights_with_free_,
                           others_, shape_, part.component.label);
    if (volume.frames > 0) track(volume, part, live);
    volume.last_centre_c_m = part.points.centre_c_m;
    volume.follow(part.points);
    integration_.integrate_moving(volume.volume(), live.depth_m, own_weights_, weights_with_free_,
                                  volume.T_g_c(), volume.layers(part.points), config_.adaptive);
    drop_component_.launch(size, own_weights_, weights_with_free_, others_, shape_);
    ++volume.frames;
    if (volume.frames % prune_every_frames == 0) volume.prune();
    no_prediction_.launch(size, volume.prediction.depth_m, shape_);
    raycasting_.raycast_tiles(volume.volume(), volume.T_g_c(), tiles_around(part.points, shape_),
                              volume.prediction);
    volume.region = part.region;
}

void ForegroundModel::track(MovingVolume& volume, const Part& part, const LiveMaps& live) {
    RigidTransform shifted = RigidTransform::Identity();
    shifted.translation() = volume.last_centre_c_m - part.points.centre_c_m;
    const std::array guesses{RigidTransform::Identity(), volume.last_step_T_p_c, shifted};
    TrackingResult result =
        tracking_.track(live, volume.prediction, guesses, nullptr, {&others_, part.region}, volume.frames);
    judge_step(config_.tracking, result.T_p_c, result);
    if (result.state == TrackingState::lost)
        volume.clear();
    else
        volume.move(result.T_p_c);
}

void ForegroundModel::take_prediction(const MovingVolume& volume, const Part& part, const LiveMaps& live,
                                      const Foreground& foreground) {
    take_prediction_.launch(eight_pixels_each(shape_, volume.region), foreground.labels, live.filtered_m,
                            volume.prediction.depth_m, volume.prediction.normals_c, surface_.depth_m,
                            surface_.normals_c, source_, shape_, config_.weights.noise, config_.gate_sigmas,
                            part.component.label);
}

}  // namespace touchstone
