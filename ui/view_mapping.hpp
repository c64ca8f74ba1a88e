#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "platform/display/picture.hpp"

namespace touchstone {

/// A rectangle of the display: pixels, y down, origin at the display's upper left corner.
struct DisplayRect {
    Eigen::Vector2f min_px{0.f, 0.f};
    Eigen::Vector2f max_px{0.f, 0.f};

    Eigen::Vector2f size_px() const { return max_px - min_px; }
    Eigen::Vector2f center_px() const { return 0.5f * (min_px + max_px); }
};

/// Takes places in the depth picture to places on the display. Pixel centres lie at whole numbers in the
/// depth picture (as in Intrinsics), at whole numbers plus a half on the display (as in GL).
struct ViewMapping {
    DisplayRect rect;               ///< where the whole depth picture lies
    float display_px_per_px = 1.f;  ///< the same across and down

    Eigen::Vector2f to_display(const Eigen::Vector2f& pixel_px) const {
        return rect.min_px + (pixel_px + Eigen::Vector2f(0.5f, 0.5f)) * display_px_per_px;
    }
    Eigen::Vector2f to_view(const Eigen::Vector2f& display_px) const {
        return (display_px - rect.min_px) / display_px_per_px - Eigen::Vector2f(0.5f, 0.5f);
    }
};

/// The largest picture of that size that fits `room`, in its middle, its aspect kept.
inline ViewMapping fit_view(PixelSize view, const DisplayRect& room) {
    const Eigen::Vector2f view_size(static_cast<float>(view.width_px), static_cast<float>(view.height_px));
    ViewMapping mapping;
    mapping.display_px_per_px = (room.size_px().cwiseQuotient(view_size)).minCoeff();
    const Eigen::Vector2f half = 0.5f * mapping.display_px_per_px * view_size;
    mapping.rect = {room.center_px() - half, room.center_px() + half};
    return mapping;
}

}  // namespace touchstone
