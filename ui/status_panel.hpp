#pragma once

#include <map>
#include <string_view>

#include "pipeline/touch_event.hpp"
#include "ui/canvas.hpp"
#include "ui/layout.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// How a state of the event log is called on the display.
struct StateLook {
    std::string_view word;
    style::Color color;
};

/// An unknown state is shown by its own name.
StateLook state_look(std::string_view state);

/// Everything the panel says, but for what the frame holds.
struct PanelWords {
    std::string_view invitation;
    const std::map<int, Fingertip>& touching;
};

/// Product name, state, frame rate, time of a frame, touches, note: a column beside the view or a bar under
/// it.
void draw_status_panel(Canvas& canvas, const Layout& layout, const TableFrame& frame,
                       const PanelWords& words);

}  // namespace touchstone
