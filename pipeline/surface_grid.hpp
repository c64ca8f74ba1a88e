#pragma once

#include <Eigen/Core>
#include <vector>

namespace touchstone {

/// The background as a grid of points, row-major: what the depth camera sees at every `step_px`-th pixel
/// across and down, starting at pixel (0, 0).
struct SurfaceGrid {
    int version = 0;  ///< another one for other points
    int width = 0, height = 0;
    int step_px = 1;
    std::vector<Eigen::Vector4f> points_g_m;  ///< x, y, z of the scan's frame, 1; all 0 where there is none
};

}  // namespace touchstone
