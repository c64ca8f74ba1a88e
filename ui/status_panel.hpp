#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ui/canvas.hpp"
#include "ui/layout.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// How a state of the event log is called on the display. An unknown state is shown by its own name.
struct StateLook {
    std::string word;
    style::Color color;
};
StateLook state_look(std::string_view state);

struct Figure {
    std::string value;
    std::string unit;
};

/// What the panel says.
struct StatusWords {
    StateLook state;
    std::string invitation;       ///< only while live
    std::vector<Figure> figures;  ///< those that mean something in this state
    std::vector<int> touching;    ///< ids of the fingers in contact
    std::string note;             ///< empty while the card over the view says it
};
StatusWords status_words(const TableFrame& frame, std::string_view invitation,
                         const std::vector<int>& touching);

/// Product name and status: a column beside the view or a bar under it, as the layout has it.
void draw_status_panel(Canvas& canvas, const Layout& layout, const StatusWords& words);

/// On a surface: nothing while all is well, else what is wrong, on a card in the panel's upper left corner.
void draw_status_note(Canvas& canvas, const Layout& layout, const StatusWords& words);

}  // namespace touchstone
