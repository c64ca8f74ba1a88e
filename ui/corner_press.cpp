#include "ui/corner_press.hpp"

#include <algorithm>

namespace touchstone {

bool CornerPress::is_in_corner(const Eigen::Vector2f& place_px) const {
    return has_area_ && std::ranges::any_of(corners_px_, [&](const Eigen::Vector2f& corner) {
               return (place_px - corner).norm() * mm_per_px_ < corner_reach_mm;
           });
}

void CornerPress::on_touch(const TouchEvent& event) {
    const Eigen::Vector2f& place = event.tip.pixel_px;
    if (event.phase == TouchPhase::down && is_in_corner(place)) {
        fingers_.insert_or_assign(event.tip.id, Finger{place, now_us_});
        return;
    }
    const auto finger = fingers_.find(event.tip.id);
    if (finger == fingers_.end()) return;
    const bool strayed = (place - finger->second.down_px).norm() * mm_per_px_ > corner_stray_mm;
    if (event.phase == TouchPhase::up || strayed) fingers_.erase(finger);
}

bool CornerPress::update(const TableFrame& frame, const SurfaceGeometry& surface) {
    now_us_ = frame.timestamp_us;
    has_area_ = frame.has_area;
    corners_px_ = frame.area_px;
    mm_per_px_ = surface.mm_per_px(surface.room().box_px().center());
    for (auto& [id, finger] : fingers_) {
        finger.since_us = std::min(finger.since_us, now_us_);
        if (now_us_ - finger.since_us < corner_press_us) continue;
        fingers_.clear();
        return true;
    }
    return false;
}

}  // namespace touchstone
