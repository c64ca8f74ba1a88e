#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/accuracy/baselines/raster.hpp"

namespace touchstone::baselines {

/// Pixels that hang together, as indices into the picture.
using Blob = std::vector<std::size_t>;

/// The 4-connected blobs of a mask with at least so many pixels, in the order of their first pixel.
std::vector<Blob> find_blobs(const Mask& mask, std::size_t least_px);

/// Mean pixel (u, v).
Eigen::Vector2d centroid_px(const Blob& blob, int width_px);

}  // namespace touchstone::baselines
