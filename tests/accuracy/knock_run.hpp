#pragma once

#include <optional>
#include <string>

#include "pipeline/interaction_pipeline.hpp"

namespace touchstone {

/// A table whose camera is knocked in one frame step.
struct KnockRun {
    std::string scene = "mixed";
    int seed = 1;
    int hands = 0;
    float knock_deg = 5.0f, knock_mm = 50.0f;
    int frames = 180, knock_frame = 90;
};

/// Where the camera is thought to be against where it is.
struct PoseError {
    float shift_mm = 0.0f, turn_deg = 0.0f;
    float surface_mm = 0.0f;  ///< between surface and surface, along z; 90 % of the view stays below
};

struct KnockScore {
    std::optional<int> frames_to_notice;  ///< frames from the knock to the first that is not live
    std::optional<int> frames_to_live;    ///< and to the first that is live again, never having scanned anew
    int false_alarms = 0;                 ///< states other than live between the scan and the knock, after it
    int scans_anew = 0;
    int frozen_reports = 0;                        ///< downs, moves and hovers while not live: must be none
    int early_downs = 0;                           ///< downs between the knock and its notice
    int open_touches = 0;                          ///< downs without an up when the state is no longer live
    PoseError error;                               ///< at the end
    double slowest_ms = 0.0, mean_watch_ms = 0.0;  ///< of realigning frames; of the watch in live frames
};

/// `T_true`, `T_found` map points of the camera after to the camera before.
PoseError pose_error(const RigidTransform& T_true, const RigidTransform& T_found,
                     const SurfacePrediction& prediction, const Intrinsics& intrinsics);

KnockScore run_knock(const Device& device, const KnockRun& run, const InteractionConfig& config = {});

}  // namespace touchstone
