#pragma once

#include "platform/display/picture.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// Where the view and the words about it go.
struct Layout {
    float scale = 1.f;  ///< display pixels to one pixel of style.hpp
    ViewMapping view;
    DisplayRect panel;
    bool panel_beside = false;  ///< a column left of the view, else a bar under it
    float corner_px = 0.f;      ///< of the view
};

/// A column beside the view where the display is wide enough for it, a bar below otherwise.
Layout make_layout(PixelSize display, PixelSize view);

/// The view takes all of the display, on which nothing but the surface is seen; the panel lies in its upper
/// left corner, beside the middle.
Layout make_projected_layout(PixelSize display, PixelSize view);

}  // namespace touchstone
