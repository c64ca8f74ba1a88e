#pragma once

#include "pipeline/touch_event.hpp"
#include "ui/canvas.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// Pixels of the display.
void draw_cross(Canvas& canvas, const Eigen::Vector2f& at_px);

/// The cross to touch, and under the view what to do.
void draw_cross_guide(Canvas& canvas, const ViewMapping& view, const CrossGuide& guide);

}  // namespace touchstone
