#pragma once

#include <string>
#include <vector>

#include "kernels/shared_types.h"
#include "tests/accuracy/baselines/background.hpp"
#include "tests/accuracy/baselines/baseline.hpp"
#include "tests/accuracy/touch_record.hpp"

namespace touchstone {

/// What each method reports of the same sequence, in their order.
struct BaselineRun {
    TouchTruth truth;
    std::vector<TouchLog> logs;
};

/// Shows a simulated table to the methods; `scene` is the part of the sensor's URI after `sim:`, without a
/// truth. Touched pixels become points of the surface, as in the program's own log. Throws Error.
BaselineRun run_baselines(const std::string& scene, std::vector<baselines::Method>& methods);

/// The point of the background behind a pixel, or behind the nearest pixel that has one, camera frame, mm.
/// (0, 0, 0) where nothing is within 20 pixels.
std::array<double, 3> surface_point_mm(const baselines::Background& background, const Intrinsics& k,
                                       const Eigen::Vector2d& pixel_px);

}  // namespace touchstone
