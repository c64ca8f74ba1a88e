#pragma once

#include "ui/canvas.hpp"
#include "ui/table_frame.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// True in the states in which nobody can touch yet: the card is shown instead of the scene.
bool is_waiting_state(const TableFrame& frame);

/// The card over the view that says what the table is doing or waits for. `clock_s` turns the ring while
/// there is no progress to show.
void draw_scan_progress(Canvas& canvas, const DisplayRect& view, const TableFrame& frame, float clock_s);

}  // namespace touchstone
