#include "pipeline/camera_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone {

namespace {

constexpr int coarsest = 2;
constexpr double usual_gain = 0.02;
constexpr int first_looks = 5;  ///< what is usual is not known yet

CameraTrackingConfig fitting_config(const CameraWatchConfig& config) {
    CameraTrackingConfig tracking;
    tracking.noise = config.noise;
    tracking.levels.fill({1, config.fit_distance_m, config.fit_sigmas});
    return tracking;
}

/// Coarse levels only: the pose is looked for to see whether there is one, not to be used.
CameraTrackingConfig aligning_config(const CameraWatchConfig& config) {
    CameraTrackingConfig tracking = relocalisation_tracking();
    tracking.noise = config.noise;
    tracking.levels[0] = {0, config.fit_distance_m, config.fit_sigmas};
    tracking.finds_normals = true;
    return tracking;
}

double share(double part, double whole) { return part / std::max(whole, 1.0); }

/// As TrackingResult has it.
float rms_sigmas(const AlignmentSums& sums, const SensorNoise& noise) {
    const float from_offset = 1.0f - noise.offset_m;
    const float reference_m = noise.constant_m + noise.quadratic * from_offset * from_offset;
    return static_cast<float>(std::sqrt(share(sums.weighted_squares, sums.pairs))) / reference_m;
}

}  // namespace

CameraWatch::CameraWatch(const Device& device, const CameraWatchConfig& config, const Intrinsics& intrinsics)
    : config_(config),
      fitting_(device, fitting_config(config), intrinsics),
      aligning_(device, aligning_config(config), intrinsics),
      guesses_(poses_around(3.0f, 0.04f)) {}

void CameraWatch::restart() {
    look_ = {};
    usual_fit_ = usual_seen_ = usual_noise_ = 0.0;
    frame_ = stepping_ = strange_ = doubtful_ = 0;
}

void CameraWatch::look(const LiveMaps& live, const SurfacePrediction& background,
                       const Buffer<std::uint8_t>& foreground) {
    fitting_.prepare(live, {&foreground});
    const AlignmentSums sums = fitting_.sum(background, RigidTransform::Identity(), coarsest);
    look_.fit = static_cast<float>(share(sums.pairs, sums.compared));
    usual_seen_ = std::max(sums.compared, usual_seen_);
    look_.seen = static_cast<float>(share(sums.compared, usual_seen_));
    const Vector6d twist = solve_twist(sums, 0.5, 0.01).twist;
    constexpr double deg_per_rad = 180.0 / std::numbers::pi;
    look_.step = {static_cast<float>(twist.tail<3>().norm()),
                  static_cast<float>(deg_per_rad * twist.head<3>().norm())};
    look_.noise = static_cast<float>(std::sqrt(std::max(sums.pairs, 1.0) / std::max(sums.weight, 1e-6)));
    ++look_.looks;
}

bool CameraWatch::steps_more_than(const Displacement& step, float times) const {
    const float limit = times * static_cast<float>(usual_noise_);
    return step.shift_m > limit * config_.max_step_m || step.turn_deg > limit * config_.max_step_deg;
}

CameraVerdict CameraWatch::judge(const LiveMaps& live, const SurfacePrediction& background,
                                 const Buffer<std::uint8_t>& foreground) {
    const bool was_doubtful = doubtful_ > 0 && doubtful_ <= config_.doubtful_looks;
    if (frame_++ % config_.every_frames != 0)
        return was_doubtful ? CameraVerdict::doubtful : CameraVerdict::still;
    look(live, background, foreground);
    if (look_.looks <= first_looks) {
        usual_fit_ += (static_cast<double>(look_.fit) - usual_fit_) / look_.looks;
        usual_noise_ += (static_cast<double>(look_.noise) - usual_noise_) / look_.looks;
        return CameraVerdict::still;
    }
    const float fit = look_.fit / static_cast<float>(usual_fit_);
    const bool has_background = look_.seen > config_.min_seen;
    stepping_ = has_background && steps_more_than(look_.step, 1.0f) ? stepping_ + 1 : 0;
    strange_ = has_background && fit < config_.strange_fit ? strange_ + 1 : 0;
    if (stepping_ >= config_.step_looks || strange_ >= config_.strange_looks) return CameraVerdict::moved;
    const bool suspicious = fit < config_.suspicious_fit || look_.seen < config_.suspicious_seen ||
                            steps_more_than(look_.step, config_.sudden_steps);
    if (suspicious && is_explained_by_a_knock(live, background)) return CameraVerdict::moved;
    doubtful_ = has_background && fit < config_.doubtful_fit ? doubtful_ + 1 : 0;
    usual_fit_ += usual_gain * static_cast<double>(look_.fit - static_cast<float>(usual_fit_));
    usual_seen_ *= 1.0 - 0.01 * usual_gain;
    const bool doubts = stepping_ > 0 || (doubtful_ > 0 && doubtful_ <= config_.doubtful_looks);
    return doubts ? CameraVerdict::doubtful : CameraVerdict::still;
}

bool CameraWatch::is_explained_by_a_knock(const LiveMaps& live, const SurfacePrediction& background) {
    const TrackingResult knocked = aligning_.track(live, background, guesses_);
    if (!steps_more_than(displacement(knocked.T_p_c), config_.sudden_steps)) return false;
    const AlignmentSums still = aligning_.sum(background, RigidTransform::Identity(), 0);
    const auto still_share = static_cast<float>(share(still.pairs, still.compared));
    const float still_sigmas = rms_sigmas(still, config_.noise);
    const bool fits_more = knocked.inlier_share > still_share + config_.min_gain;
    const bool fits_better = knocked.inlier_share > still_share - 0.2f * config_.min_gain &&
                             knocked.rms_sigmas < config_.min_rms_gain * still_sigmas;
    return knocked.inlier_share > config_.min_fit && (fits_more || fits_better);
}

}  // namespace touchstone
