#pragma once

#include "pipeline/finger_shape.hpp"
#include "pipeline/table_picture.hpp"

namespace touchstone {

struct FingerCoverConfig {
    float before_m = 0.02f;  ///< what is so much nearer than a finger's upper side is not that finger
    float share = 0.5f;      ///< of the round end's pixels
};

/// Whether a finger's round end would not be seen there: something is before it, or the sensor measures
/// nothing (shadow). Pixels outside the picture measure nothing.
bool is_covered(const TablePicture& picture, const FingerShape& shape, const FingerCoverConfig& config);

}  // namespace touchstone
