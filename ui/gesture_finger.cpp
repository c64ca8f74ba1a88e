#include "ui/gesture_finger.hpp"

#include <algorithm>

namespace touchstone {
namespace {

using Eigen::Vector2f;

float seconds(std::uint64_t us) { return static_cast<float>(us) * 1e-6f; }

/// Slope of the least-squares line through the places over time; zero where there is no time between them.
Vector2f velocity_px_s(const std::vector<GestureFinger::Sample>& samples) {
    const auto count = static_cast<float>(samples.size());
    const std::uint64_t first_us = samples.front().timestamp_us;
    float mean_s = 0.f;
    Vector2f mean_px(0.f, 0.f);
    for (const auto& [place_px, timestamp_us] : samples) {
        mean_s += seconds(timestamp_us - first_us) / count;
        mean_px += place_px / count;
    }
    Vector2f covariance_px_s(0.f, 0.f);
    float variance_s2 = 0.f;
    for (const auto& [place_px, timestamp_us] : samples) {
        const float dt_s = seconds(timestamp_us - first_us) - mean_s;
        covariance_px_s += dt_s * (place_px - mean_px);
        variance_s2 += dt_s * dt_s;
    }
    if (variance_s2 <= 0.f) return {0.f, 0.f};
    return covariance_px_s / variance_s2;
}

float distance_to_segment_px(const Vector2f& point_px, const Vector2f& a_px, const Vector2f& b_px) {
    const Vector2f along_px = b_px - a_px;
    const float length2 = along_px.squaredNorm();
    const float t = length2 > 0.f ? std::clamp((point_px - a_px).dot(along_px) / length2, 0.f, 1.f) : 0.f;
    return (point_px - a_px - t * along_px).norm();
}

}  // namespace

void GestureFinger::move(const Vector2f& to_px, std::uint64_t now_us, const GestureConfig& config) {
    place_px = to_px;
    std::erase_if(samples, [&](const Sample& s) { return s.timestamp_us + config.velocity_us < now_us; });
    samples.push_back({to_px, now_us});
    const float radius_px = config.tap_radius_mm / config.mm_per_px;
    const float from_rest_px = (to_px - rest_px).norm();
    frames_outside = from_rest_px > radius_px ? frames_outside + 1 : 0;
    // One frame outside is jitter, unless it is far outside.
    has_left = has_left || frames_outside >= 2 || from_rest_px > 2.f * radius_px;
    if (frames_outside > 0 || now_us > down_us + config.velocity_us) return;
    rest_px += (to_px - rest_px) / static_cast<float>(++rest_places);
}

void GestureFinger::lift(std::uint64_t now_us, const GestureConfig& config) {
    lifted_us = now_us;
    const bool seen_of_late = samples.back().timestamp_us + config.velocity_us >= now_us;
    lift_velocity_px_s = seen_of_late ? velocity_px_s(samples) : Vector2f(0.f, 0.f);
}

float GestureFinger::distance_to_way_px(const Vector2f& point_px, std::uint64_t now_us) const {
    const Vector2f way_px = lift_velocity_px_s * seconds(now_us - samples.back().timestamp_us);
    return distance_to_segment_px(point_px, place_px, place_px + way_px);
}

}  // namespace touchstone
