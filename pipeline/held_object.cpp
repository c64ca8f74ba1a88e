#include "pipeline/held_object.hpp"

#include <array>
#include <fmt/core.h>

#include "pipeline/kernel_program.hpp"
#include "pipeline/relocalisation.hpp"

namespace touchstone {

namespace {

/// Hands hold it: only what is near the model may pull.
constexpr std::array<TrackingLevel, 3> tracking_levels{
    TrackingLevel{4, 0.015f, 4.0f}, TrackingLevel{5, 0.02f, 4.0f}, TrackingLevel{8, 0.03f, 5.0f}};
/// From some 15 degrees and 2 cm off.
constexpr std::array<TrackingLevel, 3> finding_levels{
    TrackingLevel{6, 0.015f, 5.0f}, TrackingLevel{10, 0.03f, 10.0f}, TrackingLevel{20, 0.05f, 25.0f}};
constexpr float outside_margin_m = 0.01f;

HeldObjectConfig with_shared_noise(HeldObjectConfig config) {
    config.tracking.noise = config.noise;
    config.agreement.noise = config.noise;
    config.tracking.levels = tracking_levels;
    return config;
}

CameraTrackingConfig for_finding(CameraTrackingConfig config) {
    config.levels = finding_levels;
    return config;
}

}  // namespace

HeldObject::HeldObject(const Device& device, const HeldObjectConfig& config, const Intrinsics& intrinsics,
                       const VolumeSnapshot& model)
    : config_(with_shared_noise(config)),
      intrinsics_(intrinsics),
      volume_(restore_volume(device, model)),
      templates_(config_.templates, model),
      tracking_(device, config_.tracking, intrinsics),
      finding_(device, for_finding(config_.tracking), intrinsics),
      raycasting_(device, intrinsics),
      bounds_program_(load_kernel_program(device, "volume_bounds.cl")),
      mark_outside_(bounds_program_.kernel("mark_outside")),
      prediction_(device, make_map_shape(intrinsics)),
      excluded_(device, map_pixels(make_map_shape(intrinsics))) {}

HeldObjectFrame HeldObject::process(const LiveMaps& live, const Buffer<std::uint8_t>& foreground_mask) {
    return state_ == HeldObjectState::tracked ? follow(live, foreground_mask) : search(live, foreground_mask);
}

HeldObjectFrame HeldObject::follow(const LiveMaps& live, const Buffer<std::uint8_t>& mask) {
    const std::array guesses{RigidTransform::Identity(), velocity_};
    const RigidTransform T_o_before = T_o_c_;
    const Pose pose = align(tracking_, live, mask, T_o_before, guesses);
    const RigidTransform T_before_c = T_o_before.inverse() * pose.T_o_c;
    // A twist of the camera's frame: the object's own movement is what counts.
    const Displacement step = displacement(pose.T_o_c * T_o_before.inverse());
    const Eigen::Vector3f centre_m = templates_.centre_o_m();
    const float shift_m = (pose.T_o_c.inverse() * centre_m - T_o_before.inverse() * centre_m).norm();
    const bool confirmed = pose.agreement.fitting_share() >= config_.keep_fitting_share &&
                           pose.agreement.seen_share() >= config_.keep_seen_share &&
                           shift_m <= config_.max_step_m && step.turn_deg <= config_.max_step_deg;
    if (confirmed) {
        unconfirmed_frames_ = 0;
        velocity_ = T_before_c;
        T_o_c_ = pose.T_o_c;
        return tracked_frame(pose);
    }
    velocity_ = RigidTransform::Identity();
    predict(T_o_before);
    if (++unconfirmed_frames_ >= config_.patience_frames) return lose(pose.agreement);
    HeldObjectFrame frame = tracked_frame(pose);
    frame.T_c_o = T_o_before.inverse();
    frame.reason = "held where it was: it is hidden or moves too fast";
    return frame;
}

HeldObjectFrame HeldObject::lose(const ModelAgreement& agreement) {
    state_ = HeldObjectState::lost;
    reason_ = agreement.seen_share() < config_.keep_seen_share
                  ? fmt::format("only {:.0f} % of the object is seen", 100.0f * agreement.seen_share())
                  : fmt::format("only {:.0f} % of what is seen fits the object",
                                100.0f * agreement.fitting_share());
    view_.reset();
    candidates_.assign(1, T_o_c_.inverse());
    HeldObjectFrame frame;
    frame.state = state_;
    frame.reason = reason_;
    return frame;
}

HeldObjectFrame HeldObject::search(const LiveMaps& live, const Buffer<std::uint8_t>& mask) {
    HeldObjectFrame frame;
    frame.state = state_;
    frame.reason = reason_;
    if (candidates_.empty()) {
        propose(live, mask);
        return frame;
    }
    const RigidTransform T_o_start = candidates_.back().inverse();
    candidates_.pop_back();
    predict(T_o_start);
    const std::array here{RigidTransform::Identity()};
    const RigidTransform T_o_rough = align(finding_, live, mask, T_o_start, here).T_o_c;
    const Pose pose = align(tracking_, live, mask, T_o_rough, here);
    if (pose.agreement.fitting_share() < config_.find_fitting_share ||
        pose.agreement.seen_share() < config_.find_seen_share)
        return frame;
    state_ = HeldObjectState::tracked;
    T_o_c_ = pose.T_o_c;
    velocity_ = RigidTransform::Identity();
    unconfirmed_frames_ = 0;
    return tracked_frame(pose);
}

void HeldObject::propose(const LiveMaps& live, const Buffer<std::uint8_t>& mask) {
    if (!view_) {
        const auto depth_m = live.filtered_m.map_read();
        const auto foreground = mask.map_read();
        view_ = view_foreground({depth_m.values(), foreground.values(), intrinsics_, live.shape.pitch_px},
                                templates_.config().cell_m);
        next_template_ = 0;
        found_.clear();
        if (!view_) return;
    }
    const std::size_t end = next_template_ + static_cast<std::size_t>(config_.templates_a_frame);
    templates_.match(*view_, next_template_, end, config_.candidates, found_);
    next_template_ = end;
    if (end < templates_.size()) return;
    for (auto best = found_.rbegin(); best != found_.rend(); ++best) candidates_.push_back(best->T_c_o);
    view_.reset();
}

HeldObject::Pose HeldObject::align(CameraTracking& tracking, const LiveMaps& live,
                                   const Buffer<std::uint8_t>& mask, const RigidTransform& T_o_p,
                                   std::span<const RigidTransform> guesses) {
    leave_out_others(live, mask, T_o_p);
    Pose pose;
    pose.tracking = tracking.track(live, prediction_, guesses, nullptr, {&excluded_});
    pose.T_o_c = orthonormal(T_o_p * pose.tracking.T_p_c);
    predict(pose.T_o_c);
    const auto depth_m = live.filtered_m.map_read();
    const auto foreground = mask.map_read();
    const auto predicted_m = prediction_.depth_m.map_read();
    pose.agreement = compare_model(config_.agreement,
                                   {depth_m.values(), foreground.values(), intrinsics_, live.shape.pitch_px},
                                   predicted_m.values());
    return pose;
}

void HeldObject::leave_out_others(const LiveMaps& live, const Buffer<std::uint8_t>& mask,
                                  const RigidTransform& T_o_c) {
    {
        const auto foreground = mask.map_read();
        const auto excluded = excluded_.map_write();
        for (std::size_t i = 0; i < excluded.values().size(); ++i) excluded[i] = foreground[i] == 0 ? 1 : 0;
    }
    mark_outside_.launch(eight_pixels_each(live.shape), live.filtered_m, excluded_, excluded_, live.shape,
                         intrinsics_, to_pose(T_o_c), -outside_margin_m,
                         volume_.config().side_m + outside_margin_m);
}

void HeldObject::predict(const RigidTransform& T_o_c) { raycasting_.raycast(volume_, T_o_c, prediction_); }

HeldObjectFrame HeldObject::tracked_frame(const Pose& pose) const {
    HeldObjectFrame frame;
    frame.state = HeldObjectState::tracked;
    frame.T_c_o = pose.T_o_c.inverse();
    frame.agreement = pose.agreement;
    frame.rms_mm = pose.tracking.rms_mm;
    frame.held_directions = pose.tracking.held_directions;
    if (frame.held_directions > 0)
        frame.reason = fmt::format("the shape leaves {} of 6 directions open", frame.held_directions);
    return frame;
}

}  // namespace touchstone
