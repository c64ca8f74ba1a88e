#include "pipeline/projector_crosses.hpp"

namespace touchstone {

using Eigen::Vector2f;

/// From the middle outwards is no help to the hand: row by row, each from where the last one ended.
ProjectorCrosses::ProjectorCrosses(int width_px, int height_px, const ProjectorCrossesConfig& config)
    : config_(config) {
    const Vector2f size_px(static_cast<float>(width_px), static_cast<float>(height_px));
    const auto share = [&](int i, int count) {
        const float at = count > 1 ? static_cast<float>(i) / static_cast<float>(count - 1) : 0.5f;
        return config_.margin + (1.0f - 2.0f * config_.margin) * at;
    };
    for (int row = 0; row < config_.rows; ++row) {
        for (int i = 0; i < config_.columns; ++i) {
            const int column = row % 2 == 0 ? i : config_.columns - 1 - i;
            crosses_px_.push_back(
                size_px.cwiseProduct(Vector2f(share(column, config_.columns), share(row, config_.rows))));
        }
    }
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
        matches_.push_back({T_g_c * contact.mean.surface_c_m, *cross});
        go_on(timestamp_us);
    }
    const auto waited_us = static_cast<double>(timestamp_us - *since_us_);
    if (cross_px() && waited_us > 1e6 * static_cast<double>(config_.patience_s)) go_on(timestamp_us);
}

void ProjectorCrosses::go_on(std::uint64_t timestamp_us) {
    remark_.clear();
    since_us_ = timestamp_us;
    ++next_;
}

std::string ProjectorCrosses::words() const {
    const std::string what = "Touch the cross with one finger, and lift it.";
    return remark_.empty() ? what : remark_ + " " + what;
}

}  // namespace touchstone
