#include "pipeline/reconstruction.hpp"

#include <algorithm>
#include <array>
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

ReconstructionConfig with_shared_noise(ReconstructionConfig config) {
    config.conversion.noise = config.noise;
    config.tracking.noise = config.noise;
    config.weights.noise = config.noise;
    config.color.noise = config.noise;
    if (config.volume.side_m < object_side_m) config.tracking.levels = object_levels;
    return config;
}

/// Points of the middle half of the view, each way.
std::vector<Eigen::Vector3f> middle_points_c_m(const DepthView& view) {
    std::vector<Eigen::Vector3f> points;
    const Intrinsics& k = view.intrinsics;
    for (int y = k.height_px / 4; y < 3 * k.height_px / 4; ++y) {
        for (int x = k.width_px / 4; x < 3 * k.width_px / 4; ++x) {
            const float z =
                0.001f * static_cast<float>(view.depth_mm[static_cast<std::size_t>(y * k.width_px + x)]);
            if (z <= 0.0f) continue;
            points.emplace_back((static_cast<float>(x) - k.cx_px) / k.fx_px * z,
                                (static_cast<float>(y) - k.cy_px) / k.fy_px * z, z);
        }
    }
    return points;
}

/// The middle of what lies within `reach_m` behind the nearest points.
Eigen::Vector3f nearest_thing_c_m(std::vector<Eigen::Vector3f> points, float reach_m) {
    const auto near = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 50);
    std::ranges::nth_element(points, near, {}, [](const Eigen::Vector3f& p) { return p.z(); });
    const float near_m = near->z();
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : points)
        if (p.z() <= near_m + reach_m) box.extend(p);
    return {box.center().x(), box.center().y(), near_m + 0.5f * reach_m};
}

}  // namespace

std::optional<RigidTransform> place_camera(const DepthView& view, float side_m) {
    std::vector<Eigen::Vector3f> points = middle_points_c_m(view);
    if (points.size() < min_points) return std::nullopt;
    RigidTransform T_g_c = RigidTransform::Identity();
    if (side_m >= object_side_m) {
        T_g_c.translation() = side_m * Eigen::Vector3f(0.5f, 0.5f, camera_inside_share);
    } else {
        const Eigen::Vector3f thing = nearest_thing_c_m(std::move(points), 0.5f * side_m);
        T_g_c.translation() = Eigen::Vector3f::Constant(0.5f * side_m) - thing;
    }
    return T_g_c;
}

Reconstruction::Reconstruction(const Device& device, const ReconstructionConfig& config,
                               const Intrinsics& intrinsics, const RigidTransform& T_g_c)
    : device_(&device),
      config_(with_shared_noise(config)),
      intrinsics_(intrinsics),
      conversion_(device, config_.conversion, intrinsics),
      tracking_(device, config_.tracking, intrinsics),
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
        if (frame.fused) keyframes_.add_if_new(make_small_picture(view), T_g_c_);
        if (frame.tracking.state != TrackingState::lost) {
            predict();
            std::swap(live_intensity_, model_intensity_);
            model_has_intensity_ = has_intensity;
        }
        frame.T_g_c = T_g_c_;
    }
    times_.end_frame();
    return frame;
}

void Reconstruction::track(bool has_intensity, ReconstructionFrame& frame) {
    const StageTimer timer(times_, "camera tracking");
    const std::array guesses{RigidTransform::Identity(), velocity_};
    const IntensityPair intensity{live_intensity_, model_intensity_};
    mark_outside(T_g_p_);
    frame.tracking = tracking_.track(live_, prediction_, guesses,
                                     has_intensity && model_has_intensity_ ? &intensity : nullptr, &outside_,
                                     fused_frames_);
    judge_step(config_.tracking, frame.tracking.T_p_c, frame.tracking);
    if (frame.tracking.state == TrackingState::lost) {
        velocity_ = RigidTransform::Identity();
        return;
    }
    frame.tracking.T_p_c = steps_.believed(frame.tracking.T_p_c, frame.tracking.evidence);
    velocity_ = frame.tracking.T_p_c;
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
    mark_outside_.launch(eight_pixels_each(live_.shape), live_.filtered_m, outside_, live_.shape, intrinsics_,
                         to_pose(T_g_c), -outside_margin_m, config_.volume.side_m + outside_margin_m);
}

void Reconstruction::fuse(std::span<const std::uint8_t> color_rgb) {
    const Buffer<std::uint8_t>& weights = weighting_.weigh(live_);
    const std::vector<int>& bricks = [&]() -> const std::vector<int>& {
        const StageTimer timer(times_, "volumetric integration");
        const auto& updated =
            integration_.integrate(volume_, live_.depth_m, weights, T_g_c_, all_layers(volume_));
        device_->finish();
        return updated;
    }();
    if (volume_.bricks_in_use() > 0) ++fused_frames_;
    if (color_rgb.empty()) return;
    const StageTimer timer(times_, "colour");
    if (!color_) color_.emplace(*device_, config_.color, intrinsics_);
    color_->integrate(volume_, live_, color_rgb, weights, T_g_c_, bricks);
    device_->finish();
}

void Reconstruction::predict() {
    const StageTimer timer(times_, "raycast");
    raycasting_.raycast(volume_, T_g_c_, prediction_);
    T_g_p_ = T_g_c_;
    device_->finish();
}

}  // namespace touchstone
