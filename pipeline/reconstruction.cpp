#include "pipeline/reconstruction.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <utility>
#include <vector>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

constexpr float camera_inside_share = 0.1f;  // of the side, behind the front face
constexpr std::size_t min_points = 1000;
constexpr float outside_margin_m = 0.02f;

/// Hands that hold an object move beside it all the time: only what is near the model may pull.
constexpr std::array<TrackingLevel, 3> object_levels{
    TrackingLevel{4, 0.015f, 4.0f}, TrackingLevel{6, 0.02f, 4.0f}, TrackingLevel{10, 0.03f, 5.0f}};

/// Something has moved or begins to: what does not fit well must not pull at all.
constexpr std::array<TrackingLevel, 3> careful_levels{
    TrackingLevel{6, 0.03f, 3.5f, 2}, TrackingLevel{6, 0.05f, 4.0f, 2}, TrackingLevel{8, 0.08f, 6.0f}};
constexpr std::array<TrackingLevel, 3> careful_object_levels{
    TrackingLevel{6, 0.006f, 3.0f}, TrackingLevel{6, 0.01f, 3.5f}, TrackingLevel{8, 0.015f, 4.0f}};

/// Of the pairs within two sigmas, that a careful pose must keep: what moves may have had a few more.
constexpr double careful_share = 0.98;

CameraTrackingConfig careful(const ReconstructionConfig& config) {
    CameraTrackingConfig tracking = config.tracking;
    tracking.levels = config.volume.side_m < object_side_m ? careful_object_levels : careful_levels;
    return tracking;
}

/// Of an object: when less fits, a hand has begun to let go.
constexpr float object_inlier_share = 0.96f;

ReconstructionConfig with_shared_noise(ReconstructionConfig config) {
    config.conversion.noise = config.noise;
    config.tracking.noise = config.noise;
    config.weights.noise = config.noise;
    config.color.noise = config.noise;
    config.moving.association.noise = config.noise;
    config.moving.components.noise = config.noise;
    if (config.volume.side_m < object_side_m) {
        config.tracking.levels = object_levels;
        config.moving.into_unknown = true;
        config.moving.young_frames = 0;
        config.frames_per_sweep = 1;
        config.track_again_inlier_share = object_inlier_share;
    }
    return config;
}

/// Points of the middle of the view: `share` of it, each way.
std::vector<Eigen::Vector3f> middle_points_c_m(const DepthView& view, float share) {
    std::vector<Eigen::Vector3f> points;
    const Intrinsics& k = view.intrinsics;
    const auto first = [&](int size) {
        return static_cast<int>(0.5f * (1.0f - share) * static_cast<float>(size));
    };
    for (int y = first(k.height_px); y < k.height_px - first(k.height_px); ++y) {
        for (int x = first(k.width_px); x < k.width_px - first(k.width_px); ++x) {
            const float z =
                0.001f * static_cast<float>(view.depth_mm[static_cast<std::size_t>(y * k.width_px + x)]);
            if (z <= 0.0f) continue;
            points.push_back(back_project(k, x, y, z));
        }
    }
    return points;
}

/// The value that `share` of the points do not reach along an axis. Needs points.
float quantile_m(std::vector<Eigen::Vector3f>& points, int axis, float share) {
    const auto at =
        points.begin() + static_cast<std::ptrdiff_t>(share * static_cast<float>(points.size() - 1));
    std::ranges::nth_element(points, at, {}, [axis](const Eigen::Vector3f& p) { return p[axis]; });
    return (*at)[axis];
}

/// The middle of the thing that is held in the middle of the view by hands that come from the sides, about
/// two thirds of the side in size: its front, which is seen, is some fifth of a side before it.
Eigen::Vector3f held_thing_c_m(const DepthView& view, float side_m) {
    std::vector<Eigen::Vector3f> core = middle_points_c_m(view, 0.25f);
    std::vector<Eigen::Vector3f> points = middle_points_c_m(view, 0.5f);
    if (core.empty()) core = points;
    const float near_m = quantile_m(core, 2, 0.02f);
    std::erase_if(core, [&](const Eigen::Vector3f& p) { return p.z() > near_m + side_m; });
    const float z_m = quantile_m(core, 2, 0.5f) + 0.22f * side_m;
    const auto keep_near = [&](int axis, float middle_m, float reach_m) {
        std::erase_if(points,
                      [=](const Eigen::Vector3f& p) { return std::abs(p[axis] - middle_m) > reach_m; });
    };
    keep_near(2, z_m, 0.5f * side_m);
    if (points.empty()) return {0.0f, 0.0f, z_m};
    const float x_m = quantile_m(points, 0, 0.5f);
    keep_near(0, x_m, 0.25f * side_m);
    return {x_m, 0.5f * (quantile_m(points, 1, 0.01f) + quantile_m(points, 1, 0.99f)), z_m};
}

}  // namespace

std::optional<RigidTransform> place_camera(const DepthView& view, float side_m) {
    if (middle_points_c_m(view, 0.5f).size() < min_points) return std::nullopt;
    RigidTransform T_g_c = RigidTransform::Identity();
    if (side_m >= object_side_m)
        T_g_c.translation() = side_m * Eigen::Vector3f(0.5f, 0.5f, camera_inside_share);
    else
        T_g_c.translation() = Eigen::Vector3f::Constant(0.5f * side_m) - held_thing_c_m(view, side_m);
    return T_g_c;
}

Reconstruction::Reconstruction(const Device& device, const ReconstructionConfig& config,
                               const Intrinsics& intrinsics, const RigidTransform& T_g_c)
    : device_(&device),
      config_(with_shared_noise(config)),
      intrinsics_(intrinsics),
      conversion_(device, config_.conversion, intrinsics),
      tracking_(device, config_.tracking, intrinsics),
      careful_tracking_(device, careful(config_), intrinsics),
      moving_(device, config_.moving, intrinsics, config_.volume.side_m),
      volume_(device, config_.volume),
      weighting_(device, config_.weights, intrinsics),
      integration_(device, intrinsics, config_.noise),
      raycasting_(device, intrinsics),
      bounds_program_(load_kernel_program(device, "volume_bounds.cl")),
      mark_outside_(bounds_program_.kernel("mark_outside")),
      outside_(device, map_pixels(make_map_shape(intrinsics))),
      live_(device, make_map_shape(intrinsics)),
      prediction_(device, make_map_shape(intrinsics)),
      live_intensity_(device, intrinsics),
      model_intensity_(device, intrinsics),
      T_g_c_(T_g_c),
      T_g_p_(T_g_c),
      velocity_(RigidTransform::Identity()),
      steps_(config_.steps) {}

ReconstructionFrame Reconstruction::process(const DepthView& view, std::span<const std::uint8_t> color_rgb) {
    ReconstructionFrame frame;
    const bool has_intensity = config_.use_color && !color_rgb.empty();
    {
        const StageTimer whole(times_, "frame");
        {
            const StageTimer timer(times_, "depth map conversion");
            conversion_.convert(view, live_);
            if (has_intensity) tracking_.convert(color_rgb, live_intensity_);
            device_->finish();
        }
        if (fused_frames_ == 0)
            frame.tracking.state = TrackingState::good;
        else
            track(has_intensity, frame);
        if (frame.tracking.state == TrackingState::lost) relocalise(view, frame);
        frame.fused = frame.tracking.state == TrackingState::good && frames_to_prove_ == 0;
        if (frame.tracking.state == TrackingState::good && frames_to_prove_ > 0) --frames_to_prove_;
        if (frame.fused) fuse(has_intensity ? color_rgb : std::span<const std::uint8_t>{});
        if (frame.tracking.state != TrackingState::lost) {
            moving_.remember(live_, T_g_c_, frame.fused);
            if (needs_prediction(frame)) predict(has_intensity);
            if (frame.fused && frames_on_prediction_ == 0)
                keyframes_.add_if_new(make_small_picture(view), T_g_c_);
        }
        frame.T_g_c = T_g_c_;
    }
    times_.end_frame();
    return frame;
}

TrackingResult Reconstruction::align(CameraTracking& tracking, bool has_intensity,
                                     std::span<const RigidTransform> guesses) {
    const IntensityPair intensity{live_intensity_, model_intensity_};
    mark_outside(T_g_c_);
    TrackingResult result = tracking.track(live_, prediction_, guesses,
                                           has_intensity && model_has_intensity_ ? &intensity : nullptr,
                                           {&outside_}, fused_frames_);
    judge_step(config_.tracking, T_p_l().inverse() * result.T_p_c, result);
    return result;
}

void Reconstruction::align_again(bool has_intensity, TrackingResult& found) {
    const std::array guesses{T_p_l(), T_p_l() * velocity_, found.T_p_c};
    const TrackingResult again = align(careful_tracking_, has_intensity, guesses);
    if (again.state == TrackingState::lost) return;
    const auto close = [&](const RigidTransform& T_p_c) {
        return careful_tracking_.sum(prediction_, T_p_c, 0).close;
    };
    if (close(again.T_p_c) <= careful_share * close(found.T_p_c)) return;
    // Close gates leave few pairs of a noisy picture: that is no reason to think less of the pose.
    const TrackingResult before = found;
    found = again;
    if (before.state >= again.state) return;
    found.state = before.state;
    found.reason = before.reason;
    found.inlier_share = before.inlier_share;
}

void Reconstruction::find_moving(ReconstructionFrame& frame) {
    TrackingResult& tracking = frame.tracking;
    frame.moving_share = moving_.find(live_, prediction_, tracking.T_p_c, T_g_p_ * tracking.T_p_c);
    if (tracking.state != TrackingState::good || frame.moving_share < config_.poor_moving_share) return;
    tracking.state = TrackingState::poor;
    tracking.reason = fmt::format("{:.0f} % of the view moves by itself", 100.0f * frame.moving_share);
}

void Reconstruction::track(bool has_intensity, ReconstructionFrame& frame) {
    const StageTimer timer(times_, "camera tracking");
    const RigidTransform T_p_last = T_p_l();
    const std::array guesses{T_p_last, T_p_last * velocity_};
    frame.tracking = align(tracking_, has_intensity, guesses);
    find_moving(frame);
    if (frame.moving_share > config_.track_again_share ||
        frame.tracking.inlier_share < config_.track_again_inlier_share) {
        align_again(has_intensity, frame.tracking);
        find_moving(frame);
    }
    if (frame.tracking.state == TrackingState::lost) {
        moving_.forget();
        velocity_ = RigidTransform::Identity();
        return;
    }
    frame.tracking.T_p_c = steps_.believed(frame.tracking.T_p_c, frame.tracking.evidence);
    velocity_ = T_p_last.inverse() * frame.tracking.T_p_c;
    T_g_c_ = orthonormal(T_g_p_ * frame.tracking.T_p_c);
}

void Reconstruction::relocalise(const DepthView& view, ReconstructionFrame& frame) {
    const StageTimer timer(times_, "relocalisation");
    if (!relocalisation_) {
        RelocalisationConfig config;
        config.tracking.noise = config_.noise;
        relocalisation_.emplace(*device_, config, intrinsics_);
    }
    if (frames_to_prove_ == 0) relocalisation_->restart();
    frames_to_prove_ = config_.proving_frames;
    const auto T_g_c = relocalisation_->step(live_, view, volume_, T_g_c_, &keyframes_);
    if (!T_g_c) return;
    relocalisation_->restart();
    steps_.restart();
    T_g_c_ = *T_g_c;
    frame.tracking = relocalisation_->tracking();
    frame.tracking.state = TrackingState::poor;
    frame.tracking.reason = "found again";
}

void Reconstruction::mark_outside(const RigidTransform& T_g_c) {
    mark_outside_.launch(eight_pixels_each(live_.shape), live_.filtered_m, moving_.untracked(), outside_,
                         live_.shape, intrinsics_, to_pose(T_g_c), -outside_margin_m,
                         config_.volume.side_m + outside_margin_m);
}

void Reconstruction::fuse(std::span<const std::uint8_t> color_rgb) {
    const Buffer<std::uint8_t>& weights = weighting_.weigh(live_, moving_.mask());
    const std::vector<int>& bricks = [&]() -> const std::vector<int>& {
        const StageTimer timer(times_, "volumetric integration");
        const auto& updated =
            integration_.integrate(volume_, live_.depth_m, weights, T_g_c_, layers_to_fuse());
        device_->finish();
        return updated;
    }();
    if (volume_.bricks_in_use() > 0) ++fused_frames_;
    if (color_rgb.empty() || frames_on_prediction_ > 0) return;
    const StageTimer timer(times_, "colour");
    if (!color_) color_.emplace(*device_, config_.color, intrinsics_);
    color_->integrate(volume_, live_, color_rgb, weights, T_g_c_, bricks);
    device_->finish();
}

BrickLayers Reconstruction::layers_to_fuse() const {
    if (fused_frames_ <= config_.young_model_frames) return all_layers(volume_);
    return interleaved_layers(volume_, fused_frames_ % config_.frames_per_sweep, config_.frames_per_sweep);
}

RigidTransform Reconstruction::T_p_l() const { return T_g_p_.inverse() * T_g_c_; }

/// A frame or two later the model shows the same from nearly the same place.
bool Reconstruction::needs_prediction(const ReconstructionFrame& frame) {
    const Displacement moved = displacement(T_p_l());
    const bool keeps =
        frame.tracking.state == TrackingState::good && fused_frames_ > config_.young_model_frames &&
        frame.moving_share < config_.moving.min_watched_share &&
        ++frames_on_prediction_ < config_.frames_per_prediction &&
        moved.shift_m < config_.max_prediction_shift_m && moved.turn_deg < config_.max_prediction_turn_deg;
    return !keeps;
}

void Reconstruction::predict(bool has_intensity) {
    const StageTimer timer(times_, "raycast");
    raycasting_.raycast(volume_, T_g_c_, prediction_);
    T_g_p_ = T_g_c_;
    frames_on_prediction_ = 0;
    std::swap(live_intensity_, model_intensity_);
    model_has_intensity_ = has_intensity;
    device_->finish();
}

}  // namespace touchstone
