#include "ui/layout.hpp"

#include <cmath>

#include "ui/style.hpp"

namespace touchstone {

namespace {

constexpr float least_scale = 0.5f;
constexpr float scale_steps =
    16.f;  // per 1: letters are drawn anew for each scale, dragging a window makes many

constexpr float sharp_corner_px = 0.5f;         // less would fade the whole edge
constexpr float projected_panel_share = 0.42f;  // of the width: the middle is the menu's

Eigen::Vector2f size_of(PixelSize display) {
    return {static_cast<float>(display.width_px), static_cast<float>(display.height_px)};
}

float scale_of(const Eigen::Vector2f& size_px) {
    const float exact_scale = std::min(size_px.y() / 720.f, size_px.x() / 960.f);
    return std::max(least_scale, std::floor(exact_scale * scale_steps) / scale_steps);
}

}  // namespace

Layout make_layout(PixelSize display, PixelSize view) {
    const Eigen::Vector2f size = size_of(display);
    Layout layout;
    layout.scale = scale_of(size);
    layout.corner_px = style::corner_px * layout.scale;
    const Eigen::Vector2f margin = Eigen::Vector2f::Constant(style::margin_px * layout.scale);
    const float full_width = (size.y() - 2.f * margin.y()) * static_cast<float>(view.width_px) /
                             static_cast<float>(view.height_px);
    const float beside_px = size.x() - full_width - 3.f * margin.x();
    layout.panel_beside = beside_px >= style::panel_min_px * layout.scale;
    if (layout.panel_beside) {
        const float panel_px = std::min(beside_px, style::panel_max_px * layout.scale);
        layout.panel = {margin, {margin.x() + panel_px, size.y() - margin.y()}};
        layout.view = fit_view(view, {{layout.panel.max_px.x() + margin.x(), margin.y()}, size - margin});
    } else {
        const float bar_top = size.y() - style::bar_px * layout.scale;
        const float edge = 0.5f * margin.x();
        layout.panel = {{edge, bar_top}, {size.x() - edge, size.y()}};
        layout.view = fit_view(view, {{edge, edge}, {size.x() - edge, bar_top}});
    }
    return layout;
}

Layout make_projected_layout(PixelSize display, PixelSize view) {
    const Eigen::Vector2f size = size_of(display);
    Layout layout;
    layout.scale = scale_of(size);
    layout.corner_px = sharp_corner_px;
    layout.view = fit_view(view, {{0.f, 0.f}, size});
    const DisplayRect& rect = layout.view.rect;
    const Eigen::Vector2f corner = rect.min_px + Eigen::Vector2f::Constant(style::margin_px * layout.scale);
    layout.panel = {corner, {rect.min_px.x() + projected_panel_share * rect.size_px().x(), rect.max_px.y()}};
    return layout;
}

}  // namespace touchstone
