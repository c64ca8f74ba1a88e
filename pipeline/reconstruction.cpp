#include "pipeline/reconstruction.hpp"

#include <array>
#include <utility>

namespace touchstone {

namespace {

ReconstructionConfig with_shared_noise(ReconstructionConfig config) {
    config.conversion.noise = config.noise;
    config.tracking.noise = config.noise;
    config.weights.noise = config.noise;
    return config;
}

}  // namespace

Reconstruction::Reconstruction(const Device& device, const ReconstructionConfig& config,
                               const Intrinsics& intrinsics, const RigidTransform& T_g_c)
    : device_(&device),
      config_(with_shared_noise(config)),
      conversion_(device, config_.conversion, intrinsics),
      tracking_(device, config_.tracking, intrinsics),
      volume_(device, config_.volume),
      weighting_(device, config_.weights, intrinsics),
      integration_(device, intrinsics, config_.noise),
      raycasting_(device, intrinsics),
      live_(device, make_map_shape(intrinsics)),
      prediction_(device, make_map_shape(intrinsics)),
      live_intensity_(device, intrinsics),
      model_intensity_(device, intrinsics),
      T_g_c_(T_g_c),
      T_g_p_(T_g_c),
      velocity_(RigidTransform::Identity()) {}

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
        if (empty_)
            frame.tracking.state = TrackingState::good;
        else
            track(has_intensity, frame);
        frame.fused = frame.tracking.state == TrackingState::good;
        if (frame.fused) fuse();
        if (frame.tracking.state != TrackingState::lost) {
            const StageTimer timer(times_, "raycast");
            raycasting_.raycast(volume_, T_g_c_, prediction_);
            T_g_p_ = T_g_c_;
            std::swap(live_intensity_, model_intensity_);
            model_has_intensity_ = has_intensity;
            device_->finish();
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
    frame.tracking = tracking_.track(live_, prediction_, guesses,
                                     has_intensity && model_has_intensity_ ? &intensity : nullptr);
    judge_step(config_.tracking, frame.tracking.T_p_c, frame.tracking);
    if (frame.tracking.state == TrackingState::lost) {
        velocity_ = RigidTransform::Identity();
        return;
    }
    velocity_ = frame.tracking.T_p_c;
    T_g_c_ = orthonormal(T_g_p_ * frame.tracking.T_p_c);
}

void Reconstruction::fuse() {
    const StageTimer timer(times_, "volumetric integration");
    integration_.integrate(volume_, live_.depth_m, weighting_.weigh(live_), T_g_c_, all_layers(volume_));
    empty_ = false;
    device_->finish();
}

}  // namespace touchstone
