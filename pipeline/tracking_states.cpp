#include <fmt/core.h>
#include <numbers>

#include "pipeline/camera_tracking.hpp"

namespace touchstone {

namespace {

float angle_deg(const RigidTransform& T) {
    return Eigen::AngleAxisf(T.linear()).angle() * 180.0f / std::numbers::pi_v<float>;
}

}  // namespace

void judge_tracking(const CameraTrackingConfig& config, TrackingResult& result) {
    const auto percent = [](float share) { return 100.0f * share; };
    result.state = TrackingState::lost;
    if (result.model_share < config.min_model_share)
        result.reason =
            fmt::format("only {:.0f} % of the view has been scanned", percent(result.model_share));
    else if (result.inlier_share < config.lost_inlier_share)
        result.reason = fmt::format("only {:.0f} % of the view fits the scan", percent(result.inlier_share));
    else if (result.close_share < config.lost_close_share)
        result.reason = fmt::format("the view is {:.0f} mm off the scan", result.rms_mm);
    else if (result.inlier_share < config.poor_inlier_share) {
        result.state = TrackingState::poor;
        result.reason = fmt::format("{:.0f} % of the view fits the scan", percent(result.inlier_share));
    } else if (result.close_share < config.poor_close_share) {
        result.state = TrackingState::poor;
        result.reason = fmt::format("the view is {:.0f} mm off the scan", result.rms_mm);
    } else {
        result.state = TrackingState::good;
    }
}

void judge_step(const CameraTrackingConfig& config, const RigidTransform& step, TrackingResult& result) {
    const float step_m = step.translation().norm(), step_deg = angle_deg(step);
    if (step_m <= config.max_step_m && step_deg <= config.max_step_deg) return;
    result.state = TrackingState::lost;
    result.reason =
        fmt::format("moved too fast: {:.0f} mm and {:.1f} degrees in one frame", 1000.0f * step_m, step_deg);
}

}  // namespace touchstone
