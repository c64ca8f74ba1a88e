#pragma once

#include <string_view>

#include "ui/canvas.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

enum class ViewEdge { top, bottom };

/// What to do next, on a card in the middle of an edge of the view.
void draw_hint_card(Canvas& canvas, const ViewMapping& view, ViewEdge edge, style::Color color,
                    std::string_view words);

}  // namespace touchstone
