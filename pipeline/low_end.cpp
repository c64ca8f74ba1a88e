#include "pipeline/low_end.hpp"

#include <cmath>
#include <numbers>

namespace touchstone {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

// Steps of two pixels bridge single lost ones.
constexpr std::pair<int, int> steps_px[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1},
                                            {-1, 1}, {1, 1}, {-2, 0}, {2, 0}, {0, -2},  {0, 2}};

}  // namespace

Vector3f LowEndFlood::point(int x, int y) const {
    return back_project(picture_.intrinsics, x, y, picture_.live_m[index_of(picture_, x, y)]);
}

std::uint8_t& LowEndFlood::seen(int x, int y) {
    return seen_[static_cast<std::size_t>((y - origin_y_) * side_px_ + x - origin_x_)];
}

void LowEndFlood::visit(int x, int y, const Vector3f& at_m, LowEnd& end) {
    seen(x, y) = 1;
    end.points_m.push_back(at_m);
    end.pixels_px.emplace_back(static_cast<float>(x), static_cast<float>(y));
    // A lost edge pixel belongs to the finger, but nothing grows from it.
    if (picture_.mask[index_of(picture_, x, y)] != 0) stack_.emplace_back(x, y);
}

void LowEndFlood::step_around(int from_x, int from_y, LowEnd& end) {
    const Vector3f from_m = point(from_x, from_y);
    for (const auto& [dx, dy] : steps_px) {
        const int x = from_x + dx, y = from_y + dy;
        if (x < origin_x_ || y < origin_y_ || x >= origin_x_ + side_px_ || y >= origin_y_ + side_px_)
            continue;
        if (!in_picture(picture_, x, y) || seen(x, y) != 0) continue;
        const std::size_t at = index_of(picture_, x, y);
        const bool beside = std::abs(dx) + std::abs(dy) == 1;
        const float height_m = picture_.height_m[at];
        const bool lost_edge = beside && picture_.live_m[at] > 0.0f && height_m > config_.edge_height_m &&
                               height_m < UNKNOWN_HEIGHT_M;
        if (!is_foreground(picture_, at) && !lost_edge) continue;
        const Vector3f there_m = point(x, y);
        if ((there_m - from_m).squaredNorm() > config_.step_m * config_.step_m) continue;
        if ((there_m - end.seed_m).squaredNorm() > config_.radius_m * config_.radius_m) continue;
        visit(x, y, there_m, end);
    }
}

/// A quick look that spares the flood: noise inside arms and hands makes many low places.
bool LowEndFlood::is_surrounded(int x, int y, const Vector3f& seed_m) const {
    constexpr int directions = 16;
    const float ring_px = config_.ring_m * picture_.intrinsics.fx_px / seed_m.z();
    int around = 0;
    for (int i = 0; i < directions; ++i) {
        const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / directions;
        const int u = x + static_cast<int>(std::lround(ring_px * std::cos(angle)));
        const int v = y + static_cast<int>(std::lround(ring_px * std::sin(angle)));
        if (!in_picture(picture_, u, v) || !is_foreground(picture_, index_of(picture_, u, v))) continue;
        around += (point(u, v) - seed_m).norm() < config_.radius_m;
    }
    return static_cast<float>(around) > config_.most_of_ring * directions;
}

LowEnd LowEndFlood::from(int x, int y) {
    LowEnd end;
    end.seed_m = point(x, y);
    if (is_surrounded(x, y, end.seed_m)) return end;
    const int half_px = static_cast<int>(config_.radius_m * picture_.intrinsics.fx_px / end.seed_m.z()) + 2;
    origin_x_ = x - half_px, origin_y_ = y - half_px;
    side_px_ = 2 * half_px + 1;
    seen_.assign(static_cast<std::size_t>(side_px_ * side_px_), 0);
    stack_.clear();
    visit(x, y, end.seed_m, end);
    const float pixel_m = end.seed_m.z() / picture_.intrinsics.fx_px;
    const auto most_points = static_cast<std::size_t>(config_.most_area_m2 / (pixel_m * pixel_m));
    while (!stack_.empty()) {
        if (end.points_m.size() > most_points) return {end.seed_m, {}, {}};
        const auto [from_x, from_y] = stack_.back();
        stack_.pop_back();
        step_around(from_x, from_y, end);
    }
    return end;
}

}  // namespace touchstone
