#pragma once

#include "tests/accuracy/baselines/raster.hpp"

namespace touchstone::baselines {

/// Averages a mask over squares of an odd side and keeps the pixels whose average, 0 to 255, is above a
/// bound. Outside the picture the mask is 0.
Mask boxcar(const Mask& mask, int side_px, int kept_above);

}  // namespace touchstone::baselines
