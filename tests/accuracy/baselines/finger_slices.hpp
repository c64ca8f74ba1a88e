#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/accuracy/baselines/raster.hpp"

namespace touchstone::baselines {

/// Where a line of pixels crosses a finger: depth falls, stays, and rises again.
struct SliceConfig {
    int least_step_mm = 5;  ///< of depth over two pixels, on the way in and on the way out
    int most_step_mm = 57;
    int least_width_px = 3;  ///< from the last falling pixel to the first rising one
    int most_width_px = 5;
    int least_slices = 8;  ///< of a finger
    int most_gap_px = 3;   ///< between a finger's slices, along and across
};

/// Middles of a finger's slices from one end to the other.
using SliceChain = std::vector<Eigen::Vector2d>;

/// Fingers that cross rows, then fingers that cross columns; an oblique one is found both ways.
std::vector<SliceChain> find_slice_chains(const DepthPicture& picture, const SliceConfig& config);

}  // namespace touchstone::baselines
