#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/interaction_pipeline.hpp"

namespace touchstone {

/// A thing that a simulated hand puts down and takes again, once or again and again.
struct PutAndTakeScore {
    int cycles = 0;
    int settled = 0, taken = 0, lifted = 0;   ///< lifted: out of the scan, wrongly
    double settle_s = 0.0;                    ///< from the hand's leaving to background, mean
    double back_s = 0.0;                      ///< from taking hold until what was before is back, largest
    int bricks_before = 0, bricks_after = 0;  ///< of the background
    double megabytes_first = 0.0, megabytes_last = 0.0;  ///< of the process, after the 5th and the last cycle
    double ghost_mm = 0.0;   ///< prediction at the end against before, largest where the thing stood
    int ghost_vertices = 0;  ///< of the background's mesh, 15 mm or more over the table where the thing stood
    double stage_ms = 0.0, stage_p99_ms = 0.0;  ///< of the object stage
};
PutAndTakeScore run_put_and_take(const Device& device, const std::string& scene, int seed, int cycles);

/// A thing of the scanned scene that a hand takes away.
struct LiftScore {
    bool lifted = false;
    int cuts = 0;
    double after_s = 0.0;     ///< from the first frame in which hand and thing have left the view
    double iou = 0.0;         ///< voxels at or behind a surface: taken against those inside the true shape
    double surface_mm = 0.0;  ///< mean distance of the mesh's vertices to the true shape
    double rest_mm = 0.0;     ///< prediction after against the table without the thing, where it stood, mean
};
LiftScore run_lift(const Device& device, const std::string& scene, int seed, const std::string& object);

/// A hand that works in the view during the scan.
struct MoverScore {
    int live_after_frames = 0;   ///< 0: never
    double wrong_share = 0.0;    ///< of the picture whose prediction is 15 mm or more nearer than the table
    double unknown_share = 0.0;  ///< of the picture without a prediction
};
MoverScore run_scan_with_mover(const Device& device, const std::string& scene, int seed, int hands);

}  // namespace touchstone
