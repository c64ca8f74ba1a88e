#include "pipeline/fingertip_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pipeline/table_picture.hpp"

namespace touchstone {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

bool in_area(const Vector2f& uv, float margin) {
    return uv.minCoeff() >= -margin && uv.maxCoeff() <= 1.0f + margin;
}

}  // namespace

float FingertipTracking::seconds_since_last(std::uint64_t timestamp_us) const {
    if (last_us_ == 0 || timestamp_us <= last_us_) return 1.0f / 30.0f;
    return std::clamp(static_cast<float>(timestamp_us - last_us_) * 1e-6f, 0.005f, 0.2f);
}

Vector3f FingertipTracking::expected_center_m(const Track& track, float dt_s) const {
    const int frames = 1 + std::min(track.missed, config_.bridged_frames);
    const Vector3f step = dt_s * static_cast<float>(frames) * track.velocity_m_s;
    const float below_m = -(track.tip.height_m + step.dot(track.tip.normal_c));
    return track.tip.shape.center_m + step + std::clamp(below_m, 0.0f, step.norm()) * track.tip.normal_c;
}

std::vector<KnownFinger> FingertipTracking::expected(std::uint64_t timestamp_us) const {
    const float dt_s = seconds_since_last(timestamp_us);
    std::vector<KnownFinger> known;
    for (const Track& track : tracks_) {
        FingerShape shape = track.tip.shape;
        shape.center_m = expected_center_m(track, dt_s);
        known.push_back({shape, track.radius, config_.axis_sigma});
    }
    return known;
}

float FingertipTracking::gate_of(const Track& track, float dt_s) const {
    if (track.age < 2) return config_.new_gate_m;
    const float step_m = (expected_center_m(track, dt_s) - track.tip.shape.center_m).norm();
    const float gate_m = config_.gate_m + config_.gate_steps * step_m;
    return track.missed > config_.bridged_frames ? std::max(gate_m, config_.hidden_gate_m) : gate_m;
}

std::vector<int> FingertipTracking::assign(std::span<const FingertipCandidate> tips, float dt_s) const {
    std::vector<std::tuple<float, std::size_t, std::size_t>> pairs;
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
        const Track& track = tracks_[t];
        const Vector3f expected = expected_center_m(track, dt_s);
        const float gate = gate_of(track, dt_s);
        for (std::size_t i = 0; i < tips.size(); ++i) {
            const float distance = (tips[i].shape.center_m - expected).norm();
            if (distance <= gate) pairs.emplace_back(distance, t, i);
        }
    }
    std::ranges::sort(pairs);
    std::vector<int> tip_of_track(tracks_.size(), -1);
    std::vector<bool> taken(tips.size(), false);
    for (const auto& [distance, t, i] : pairs) {
        if (tip_of_track[t] >= 0 || taken[i]) continue;
        tip_of_track[t] = static_cast<int>(i);
        taken[i] = true;
    }
    return tip_of_track;
}

void FingertipTracking::follow(Track& track, const FingertipCandidate& tip, float dt_s) const {
    const float since_s = dt_s * static_cast<float>(1 + track.missed);
    Vector3f velocity = (tip.shape.center_m - track.tip.shape.center_m) / since_s;
    if (velocity.norm() > config_.most_speed_m_s) velocity *= config_.most_speed_m_s / velocity.norm();
    const float gain = track.age < 2 ? 1.0f : config_.velocity_gain;
    track.velocity_m_s += gain * (velocity - track.velocity_m_s);
    track.tip = tip;
    track.missed = track.missed_in_sight = 0;
    track.unseen_s = 0.0f;
    ++track.age;
    track.low = tip.height_m < down_limit_m(tip) ? track.low + 1 : 0;
    const float frames = std::min(static_cast<float>(track.age), config_.radius_frames);
    track.radius.radius_m += (tip.shape.radius_m - track.radius.radius_m) / frames;
    track.radius.sigma_m = std::max(config_.radius_floor_m, config_.radius_first_sigma_m / std::sqrt(frames));
}

void FingertipTracking::miss(Track& track, float dt_s, const CoverTest& is_covered) const {
    FingerShape shape = track.tip.shape;
    shape.center_m = expected_center_m(track, dt_s);
    const bool covered = track.down && is_covered && is_covered(shape);
    ++track.missed;
    track.missed_in_sight = covered ? 0 : track.missed_in_sight + 1;
    track.unseen_s += dt_s;
}

bool FingertipTracking::is_waited_for(const Track& track) const {
    const bool was_covered = track.missed_in_sight < track.missed;
    return track.missed_in_sight <= config_.bridged_frames &&
           (!was_covered || track.missed <= config_.bridged_frames || track.unseen_s <= config_.hidden_s);
}

FingerState FingertipTracking::state_of(const Track& track) const {
    const bool seen = track.missed == 0;
    if (!track.down) return seen ? FingerState::hover : FingerState::away;
    if (!seen) return FingerState::hidden;
    return track.dragged ? FingerState::dragging : FingerState::down;
}

void FingertipTracking::report(Track& track, const InteractiveArea& area, const Intrinsics& intrinsics,
                               TrackedTouches& out) {
    const bool seen = track.missed == 0;
    const FingertipCandidate& tip = track.tip;
    const Vector3f place_c_m = corrected({tip.surface_c_m, tip.normal_c, tip.shape.axis}, bias_);
    const Vector2f uv = area_uv(area, place_c_m);
    const bool was_down = track.was_down;
    if (seen) {
        track.down = touches(track, uv);
    } else if (!is_waited_for(track) || is_doubled(track)) {
        track.down = false;
    }
    if (track.down && !was_down) {
        track.down_c_m = track.tip.surface_c_m;
        track.dragged = false;
    }
    track.dragged = track.dragged || (track.tip.surface_c_m - track.down_c_m).norm() > config_.drag_m;
    track.last.state = state_of(track);
    if (was_down && !track.down) {
        out.touches.push_back({track.last, TouchPhase::up});
        if (seen) out.touches.back().tip.id = track.id;
    }
    if (seen) {
        track.last.id = track.id;
        track.last.surface_c_m = place_c_m;
        track.last.pixel_px = project(intrinsics, place_c_m);
        track.last.area_uv = uv;
        track.last.height_m = tip.height_m;
        track.last.normal_c = tip.normal_c;
        track.last.axis_c = tip.shape.axis;
    }
    if (track.down) {
        out.touches.push_back({track.last, was_down ? TouchPhase::move : TouchPhase::down});
    } else if (seen && !was_down && in_area(uv, config_.area_margin)) {
        out.hovers.push_back({track.last});
    }
}

float FingertipTracking::noise_factor(const FingertipCandidate& tip) const {
    const float factor = sigma_z_m(config_.noise, tip.shape.center_m.z()) / sigma_z_m(config_.noise, 1.0f);
    return std::clamp(factor, 1.0f, config_.most_noise);
}

float FingertipTracking::down_limit_m(const FingertipCandidate& tip) const {
    const float unsure_m = std::max(0.0f, tip.height_sigma_m - noise_factor(tip) * config_.sure_sigma_m);
    return noise_factor(tip) * config_.down_m - config_.unsure_gain * unsure_m;
}

bool FingertipTracking::touches(const Track& track, const Vector2f& uv) const {
    const float limit_m = track.was_down ? noise_factor(track.tip) * config_.up_m : down_limit_m(track.tip);
    if (track.tip.height_m >= limit_m || !in_area(uv, config_.area_margin)) return false;
    if (track.was_down) return true;
    const int frames = is_beside_touch(track) ? config_.beside_frames : 1;
    return track.age >= config_.least_age_frames && track.low >= frames;
}

bool FingertipTracking::is_beside_touch(const Track& track) const {
    return std::ranges::any_of(tracks_, [&](const Track& other) {
        return &other != &track && other.was_down &&
               (other.tip.shape.center_m - track.tip.shape.center_m).norm() < config_.beside_m;
    });
}

bool FingertipTracking::is_followed(const Vector3f& center_m) const {
    return std::ranges::any_of(tracks_, [&](const Track& track) {
        return track.missed == 0 && (track.tip.shape.center_m - center_m).norm() < config_.apart_m;
    });
}

bool FingertipTracking::is_doubled(const Track& track) const {
    return track.missed > 0 && is_followed(track.tip.shape.center_m);
}

TrackedTouches FingertipTracking::update(std::span<const FingertipCandidate> tips,
                                         const InteractiveArea& area, const Intrinsics& intrinsics,
                                         std::uint64_t timestamp_us, const CoverTest& is_covered) {
    const float dt_s = seconds_since_last(timestamp_us);
    last_us_ = timestamp_us;
    const std::vector<int> tip_of_track = assign(tips, dt_s);
    std::vector<bool> taken(tips.size(), false);
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
        if (tip_of_track[t] < 0) {
            miss(tracks_[t], dt_s, is_covered);
            continue;
        }
        const auto i = static_cast<std::size_t>(tip_of_track[t]);
        taken[i] = true;
        follow(tracks_[t], tips[i], dt_s);
    }
    std::erase_if(tracks_,
                  [&](const Track& track) { return !track.down && track.missed > 0 && is_doubled(track); });
    for (std::size_t i = 0; i < tips.size(); ++i) {
        if (taken[i] || is_followed(tips[i].shape.center_m)) continue;
        Track track;
        track.id = next_id_++;
        track.tip = tips[i];
        track.radius = {tips[i].shape.radius_m, config_.radius_first_sigma_m};
        track.low = tips[i].height_m < down_limit_m(tips[i]) ? 1 : 0;
        tracks_.push_back(track);
    }
    TrackedTouches out;
    for (Track& track : tracks_) track.was_down = track.down;
    for (Track& track : tracks_) report(track, area, intrinsics, out);
    std::erase_if(tracks_,
                  [&](const Track& track) { return !track.down && track.missed > config_.bridged_frames; });
    return out;
}

std::vector<TouchEvent> FingertipTracking::release_all() {
    std::vector<TouchEvent> ups;
    for (const Track& track : tracks_)
        if (track.down) ups.push_back({track.last, TouchPhase::up});
    tracks_.clear();
    return ups;
}

}  // namespace touchstone
