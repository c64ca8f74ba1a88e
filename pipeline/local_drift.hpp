#pragma once

#include "pipeline/table_picture.hpp"

namespace touchstone {

struct LocalDriftConfig {
    float inner_m = 0.016f;  ///< ring of background around a fingertip
    float outer_m = 0.034f;
    int least_pixels = 24;  ///< of it, else nothing is known
    int clear_px = 3;       ///< it keeps this far from the foreground, whose edges flicker
    float most_m = 0.012f;  ///< the sensor's drift is less; a ring that says more is on something else
};

/// Height that the background around a point of it seems to have: what the sensor's slow drift leaves
/// uncorrected there. 0 where too little of the ring is seen.
float local_drift_m(const TablePicture& picture, const SurfacePoint& middle, const LocalDriftConfig& config);

}  // namespace touchstone
