#pragma once

#include "pipeline/touch_event.hpp"
#include "ui/canvas.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// The cross to touch, and under the view what to do.
void draw_cross_guide(Canvas& canvas, const ViewMapping& view, const CrossGuide& guide);

}  // namespace touchstone
