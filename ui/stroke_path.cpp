#include "ui/stroke_path.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

constexpr float least_step_px = 0.25f;  // a finger at rest leaves no pile of dots
constexpr float piece_length_px = 3.f;
constexpr int most_pieces = 64;

}  // namespace

StrokePath::StrokePath(const Eigen::Vector2f& start_px, std::vector<StrokePiece>& pieces)
    : drawn_to_px_(start_px), place_px_(start_px) {
    pieces.push_back({start_px, start_px});
}

void StrokePath::move(const Eigen::Vector2f& to_px, std::vector<StrokePiece>& pieces) {
    if ((to_px - place_px_).norm() < least_step_px) return;
    const Eigen::Vector2f from = drawn_to_px_;
    const Eigen::Vector2f control = place_px_;
    const Eigen::Vector2f end = 0.5f * (place_px_ + to_px);
    const float length_px = (control - from).norm() + (end - control).norm();
    const int count = std::clamp(static_cast<int>(std::ceil(length_px / piece_length_px)), 1, most_pieces);
    Eigen::Vector2f last = from;
    for (int i = 1; i <= count; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(count);
        const float s = 1.f - t;
        const Eigen::Vector2f next = s * s * from + 2.f * s * t * control + t * t * end;
        pieces.push_back({last, next});
        last = next;
    }
    drawn_to_px_ = end;
    place_px_ = to_px;
}

void StrokePath::finish(std::vector<StrokePiece>& pieces) {
    if (drawn_to_px_ != place_px_) pieces.push_back({drawn_to_px_, place_px_});
    drawn_to_px_ = place_px_;
}

}  // namespace touchstone
