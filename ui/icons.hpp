#pragma once

#include <string_view>

#include "ui/canvas.hpp"

namespace touchstone {

enum class Icon {
    menu,
    paint,
    particles,
    mirror,
    photos,
    inspect,
    attract,
    scene,  ///< of one that has no picture of its own
    each_finger,
    colour,
    eraser,
    width,
    undo,
    clear,
    shaded,
    normals,
    hand,
    rescan,
    cross,
    projector,
    record,
    close,
};

Icon scene_icon(std::string_view scene_name);

/// Drawn with lines in one colour, so that it is crisp at any size. `side_px` is of the square about it on
/// the display. `fill` 0..1 is the share of a dot that Icon::width and Icon::colour show.
void draw_icon(Canvas& canvas, Icon icon, const Eigen::Vector2f& center_px, float side_px, style::Color color,
               float fill = 1.f);

}  // namespace touchstone
