#include "ui/surface_room.hpp"

#include <algorithm>

namespace touchstone {

namespace {

using Eigen::AlignedBox2f;
using Eigen::Vector2f;

std::array<Vector2f, 4> corners_of(const AlignedBox2f& box) {
    return {box.corner(AlignedBox2f::TopLeft), box.corner(AlignedBox2f::TopRight),
            box.corner(AlignedBox2f::BottomRight), box.corner(AlignedBox2f::BottomLeft)};
}

float clamped_or_middle(float value, float low, float high) {
    return low > high ? 0.5f * (low + high) : std::clamp(value, low, high);
}

}  // namespace

SurfaceRoom::SurfaceRoom(const AlignedBox2f& box_px) : corners_px_(corners_of(box_px)), box_px_(box_px) {}

SurfaceRoom::SurfaceRoom(const std::array<Vector2f, 4>& corners_px, const AlignedBox2f& box_px)
    : SurfaceRoom(box_px) {
    AlignedBox2f about;
    for (const Vector2f& corner : corners_px) about.extend(corner);
    about = about.intersection(box_px);
    if (about.isEmpty()) return;
    corners_px_ = corners_px;
    box_px_ = about;
}

std::optional<Vector2f> SurfaceRoom::span_px(float y_px) const {
    float left = box_px_.max().x(), right = box_px_.min().x();
    for (std::size_t i = 0; i < 4; ++i) {
        const Vector2f &a = corners_px_[i], &b = corners_px_[(i + 1) % 4];
        if ((a.y() < y_px) == (b.y() < y_px)) continue;
        const float x = a.x() + (y_px - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        left = std::min(left, x);
        right = std::max(right, x);
    }
    left = std::max(left, box_px_.min().x());
    right = std::min(right, box_px_.max().x());
    if (left >= right) return std::nullopt;
    return Vector2f(left, right);
}

Vector2f SurfaceRoom::nearest_px(const Vector2f& center_px, const Vector2f& half_box_px) const {
    constexpr float within_px = 1e-2f;  // of the upper and lower edge, where the span is that of a corner
    const float top = box_px_.min().y(), bottom = box_px_.max().y();
    const float y = clamped_or_middle(center_px.y(), top + half_box_px.y(), bottom - half_box_px.y());
    const auto span_at = [&](float row) {
        const float inside = std::clamp(row, top + within_px, std::max(top + within_px, bottom - within_px));
        return span_px(inside).value_or(Vector2f::Constant(box_px_.center().x()));
    };
    const Vector2f upper = span_at(y - half_box_px.y()), lower = span_at(y + half_box_px.y());
    const float left = std::max(upper.x(), lower.x()), right = std::min(upper.y(), lower.y());
    return {clamped_or_middle(center_px.x(), left + half_box_px.x(), right - half_box_px.x()), y};
}

}  // namespace touchstone
