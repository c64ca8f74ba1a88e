#pragma once

#include "ui/canvas.hpp"

namespace touchstone {

/// Fades all that a canvas holds.
void fade(Canvas& canvas, float opacity);

}  // namespace touchstone
