#pragma once

#include "ui/canvas.hpp"
#include "ui/operator_view.hpp"
#include "ui/table_frame.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// Where things lie on the operator's card: words at the left, two pictures one over the other at the right.
struct OperatorCardLayout {
    DisplayRect card;

    DisplayRect words(float scale) const;
    DisplayRect depth_box(float scale) const;
    DisplayRect mask_box(float scale) const;
};

/// State, rates, times and faults; frames for the pictures, which are drawn by others.
void draw_operator_card(Canvas& canvas, const OperatorCardLayout& layout, const TableFrame& frame,
                        const OperatorView& view);

}  // namespace touchstone
