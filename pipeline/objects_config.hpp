#pragma once

#include <string>

#include "kernels/shared_types.h"

namespace touchstone {

/// Things that are put down, taken away and lifted out of the scan (Fig 5).
struct ObjectsConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float quantisation_per_m = 0.00084f;  ///< standard deviation of 1/z by rounding to steps of disparity
    float settle_s = 3.0f;                ///< what stands still for so long becomes background
    float max_side_m = 0.6f;              ///< people and furniture are no objects
    int border_px = 16;                   ///< what comes so near the picture's border may be an arm
    int near_px = 12;                     ///< nothing moves within so many pixels
    float still_sigmas = 4.0f;            ///< a depth that differs by less has not changed
    float min_taken_share = 0.2f;         ///< of its surface behind which something is seen: it is gone
    int taken_frames = 2;                 ///< for so many frames
    float min_shifted_share = 0.05f;      ///< the same where it was pushed a little ...
    int shifted_frames = 15;              ///< ... and stays so
    float min_lifted_area_m2 = 4e-4f;     ///< of what appears behind a lifted thing
    int lifted_frames = 8;                ///< for which that stands still
    float give_up_s = 3.0f;  ///< what does not come to rest by then wears away as everything does
    std::string export_dir;  ///< meshes of what was lifted; empty: none
};

}  // namespace touchstone
