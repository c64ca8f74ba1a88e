#include "pipeline/projector_crosses.hpp"

#include <Eigen/Geometry>
#include <array>

#include "pipeline/homography.hpp"

namespace touchstone {

using Eigen::Vector2f;

namespace {

/// Of the picture; the last four are shown only when the first are not enough.
constexpr std::array<std::array<float, 2>, 8> first_places{{{0.35f, 0.35f},
                                                            {0.65f, 0.35f},
                                                            {0.65f, 0.65f},
                                                            {0.35f, 0.65f},
                                                            {0.5f, 0.5f},
                                                            {0.5f, 0.25f},
                                                            {0.25f, 0.5f},
                                                            {0.75f, 0.5f}}};
/// Of the area, around it.
constexpr std::array<std::array<float, 2>, 8> later_places{{{0.1f, 0.12f},
                                                            {0.5f, 0.08f},
                                                            {0.9f, 0.12f},
                                                            {0.92f, 0.5f},
                                                            {0.9f, 0.88f},
                                                            {0.5f, 0.92f},
                                                            {0.1f, 0.88f},
                                                            {0.08f, 0.5f}}};
constexpr std::size_t least_matches = 4;

}  // namespace

ProjectorCrosses::ProjectorCrosses(int width_px, int height_px, const InteractiveArea& area_g,
                                   const ProjectorCrossesConfig& config)
    : size_px_(static_cast<float>(width_px), static_cast<float>(height_px)),
      area_g_(area_g),
      config_(config) {
    for (const auto& [x, y] : first_places) crosses_px_.push_back(size_px_.cwiseProduct(Vector2f(x, y)));
}

std::optional<Vector2f> ProjectorCrosses::cross_px() const {
    if (next_ >= wanted()) return std::nullopt;
    return crosses_px_[static_cast<std::size_t>(next_)];
}

void ProjectorCrosses::take(std::span<const TouchEvent> touches, const RigidTransform& T_g_c,
                            std::uint64_t timestamp_us) {
    if (!since_us_) since_us_ = timestamp_us;
    if (!touches.empty()) since_us_ = timestamp_us;
    for (const EndedContact& contact : contacts_.take(touches)) {
        const auto cross = cross_px();
        if (!cross) return;
        if (contact.drag_m > config_.most_drag_m) {
            remark_ = "That finger moved: touch, hold still, lift.";
            continue;
        }
        const Eigen::Vector3f touched_g_m = T_g_c * contact.mean.surface_c_m;
        if (!matches_.empty() && (touched_g_m - matches_.back().point_g_m).norm() < config_.apart_m) continue;
        matches_.push_back({touched_g_m, *cross});
        go_on(timestamp_us);
    }
    const auto waited_us = static_cast<double>(timestamp_us - *since_us_);
    if (cross_px() && waited_us > 1e6 * static_cast<double>(config_.patience_s)) go_on(timestamp_us);
}

void ProjectorCrosses::go_on(std::uint64_t timestamp_us) {
    remark_.clear();
    since_us_ = timestamp_us;
    ++next_;
    if (!is_spread_ && matches_.size() >= least_matches) spread();
}

/// What was touched tells where the area's edges lie in the picture.
void ProjectorCrosses::spread() {
    std::vector<PlaneMatch> places;
    for (const ProjectorMatch& match : matches_)
        places.push_back({area_uv(area_g_, match.point_g_m).cast<double>(), match.pixel_px.cast<double>()});
    const auto H = fit_homography(places);
    if (!H) return;  // three on a line: another of the first may help
    is_spread_ = true;
    crosses_px_.resize(static_cast<std::size_t>(next_));
    const Vector2f free_px = config_.margin * size_px_;
    for (const auto& [u, v] : later_places) {
        const Eigen::Vector3d h = *H * Eigen::Vector3d(static_cast<double>(u), static_cast<double>(v), 1.0);
        if (h.z() <= 0.0) continue;
        const Vector2f at_px = h.hnormalized().cast<float>();
        crosses_px_.push_back(at_px.cwiseMax(free_px).cwiseMin(size_px_ - free_px));
    }
}

std::string ProjectorCrosses::words() const {
    const std::string what = "Touch the cross with one finger, and lift it.";
    return remark_.empty() ? what : remark_ + " " + what;
}

}  // namespace touchstone
