#include "ui/layout.hpp"

#include <cmath>

#include "ui/style.hpp"

namespace touchstone {

namespace {

constexpr float least_scale = 0.5f;
constexpr float scale_steps =
    16.f;  // per 1: letters are drawn anew for each scale, dragging a window makes many

}  // namespace

Layout make_layout(PixelSize display, PixelSize view) {
    const Eigen::Vector2f size(static_cast<float>(display.width_px), static_cast<float>(display.height_px));
    Layout layout;
    const float exact_scale = std::min(size.y() / 720.f, size.x() / 960.f);
    layout.scale = std::max(least_scale, std::floor(exact_scale * scale_steps) / scale_steps);
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

}  // namespace touchstone
