#include "pipeline/relocalisation.hpp"

#include <array>
#include <numbers>

namespace touchstone {

namespace {

constexpr float rad_per_deg = std::numbers::pi_v<float> / 180.0f;

}  // namespace

Displacement displacement(const RigidTransform& T) {
    return {T.translation().norm(), std::abs(Eigen::AngleAxisf(T.linear()).angle()) / rad_per_deg};
}

std::vector<RigidTransform> poses_around(float turn_deg, float shift_m) {
    std::vector<RigidTransform> poses{RigidTransform::Identity()};
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0f, -1.0f}) {
            if (turn_deg <= 0.0f) break;
            poses.emplace_back(Eigen::AngleAxisf(sign * turn_deg * rad_per_deg, Eigen::Vector3f::Unit(axis)));
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0f, -1.0f}) {
            if (shift_m <= 0.0f) break;
            poses.emplace_back(Eigen::Translation3f(sign * shift_m * Eigen::Vector3f::Unit(axis)));
        }
    }
    return poses;
}

namespace {

/// Coarse levels only, and what would fit at the finest one.
CameraTrackingConfig coarse_only(CameraTrackingConfig config) {
    config.levels[0].iterations = 0;
    return config;
}

}  // namespace

Relocalisation::Relocalisation(const Device& device, const RelocalisationConfig& config,
                               const Intrinsics& intrinsics)
    : config_(config),
      coarse_tracking_(device, coarse_only(config.tracking), intrinsics),
      tracking_(device, config.tracking, intrinsics),
      raycasting_(device, intrinsics),
      prediction_(device, make_map_shape(intrinsics)),
      around_(poses_around(config.turn_deg, 0.0f)),
      guesses_(poses_around(config.guess_turn_deg, config.guess_shift_m)) {
    around_.insert(around_.begin(), RigidTransform::Identity());
}

void Relocalisation::restart() {
    next_ = 0;
    best_.reset();
    pending_.reset();
    matches_.clear();
}

std::optional<RigidTransform> Relocalisation::step(const LiveMaps& live, const DepthView& view,
                                                   const TsdfVolume& volume, const RigidTransform& T_g_last,
                                                   const KeyframeDatabase* keyframes) {
    if (pending_) {
        const auto place = verify(live, volume, *pending_);
        pending_.reset();
        if (place && place->tracking.inlier_share >= config_.sure_inlier_share) return found(place);
        if (place && place->tracking.inlier_share > best_share() + config_.better_share) best_ = place;
        return std::nullopt;
    }
    if (const auto candidate = next_candidate(view, T_g_last, keyframes)) {
        // The first is without guesses: directions that the view does not tell stay as they were.
        const bool is_first = next_ == 1;
        const auto place = align(live, volume, *candidate, is_first ? 1 : guesses_.size());
        // What is aligned coarsely fits less than it will.
        if (place && place->tracking.inlier_share + config_.coarse_loss > best_share())
            pending_ = place->T_g_c;
        return std::nullopt;
    }
    // The end of a round: the best of its places, where it still is one.
    const std::optional<Place> best = best_;
    restart();
    return best ? confirm(live, volume, best->T_g_c) : std::nullopt;
}

float Relocalisation::best_share() const { return best_ ? best_->tracking.inlier_share : 0.0f; }

std::optional<RigidTransform> Relocalisation::confirm(const LiveMaps& live, const TsdfVolume& volume,
                                                      const RigidTransform& T_g_found) {
    return found(verify(live, volume, T_g_found));
}

std::optional<RigidTransform> Relocalisation::found(const std::optional<Place>& place) {
    if (!place) return std::nullopt;
    tracking_result_ = place->tracking;
    return place->T_g_c;
}

std::optional<RigidTransform> Relocalisation::next_candidate(const DepthView& view,
                                                             const RigidTransform& T_g_last,
                                                             const KeyframeDatabase* keyframes) {
    if (next_ < around_.size()) return T_g_last * around_[next_++];
    if (next_ == around_.size() && keyframes != nullptr)
        matches_ = keyframes->most_similar(make_small_picture(view), config_.most_keyframes);
    for (; next_ - around_.size() < matches_.size(); ++next_) {
        const RigidTransform& T_g_keyframe = matches_[next_ - around_.size()].T_g_c;
        const Displacement apart = displacement(T_g_last.inverse() * T_g_keyframe);
        if (apart.shift_m < config_.guess_shift_m && apart.turn_deg < config_.guess_turn_deg) continue;
        ++next_;
        return T_g_keyframe;
    }
    return std::nullopt;
}

std::optional<Relocalisation::Place> Relocalisation::align(const LiveMaps& live, const TsdfVolume& volume,
                                                           const RigidTransform& T_g_p, std::size_t guesses) {
    raycasting_.raycast(volume, T_g_p, prediction_);
    const TrackingResult result =
        coarse_tracking_.track(live, prediction_, std::span(guesses_).first(guesses));
    if (result.state == TrackingState::lost) return std::nullopt;
    return Place{orthonormal(T_g_p * result.T_p_c), result};
}

std::optional<Relocalisation::Place> Relocalisation::verify(const LiveMaps& live, const TsdfVolume& volume,
                                                            const RigidTransform& T_g_p) {
    raycasting_.raycast(volume, T_g_p, prediction_);
    const std::array here{RigidTransform::Identity()};
    const TrackingResult result = tracking_.track(live, prediction_, here);
    const Displacement step = displacement(result.T_p_c);
    if (result.inlier_share < config_.min_inlier_share || result.model_share < config_.min_model_share ||
        result.rms_sigmas > config_.max_rms_sigmas || step.shift_m > config_.max_check_step_m ||
        step.turn_deg > config_.max_check_step_deg)
        return std::nullopt;
    return Place{orthonormal(T_g_p * result.T_p_c), result};
}

}  // namespace touchstone
