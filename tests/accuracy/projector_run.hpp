#pragma once

#include <string>

namespace touchstone {

/// The simulated projector is calibrated, then fingers touch the table that it lights.
struct ProjectorRun {
    std::string program;
    std::string scene = "curved";
    std::string method = "graycode";
    int seed = 1;
    int touch_frames = 900;  ///< of the run with fingers; 0: none
    std::string pictures;    ///< folder for what the projector throws and what the camera sees; empty: none
    std::string keys;        ///< more of the simulator's, for the calibration: "&ambient=0.6"
};

struct ProjectorScore {
    std::string model, verdict;
    double rms_px = 0.0;  ///< as the program says
    int points = 0;
    int frames = 0;  ///< of the camera that the calibration took
    /// On the true surface: between a point and where the light of its pixel falls, over all that the camera
    /// sees and the projector can light.
    double mean_mm = 0.0, p95_mm = 0.0;
    /// Between where fingers truly touch and where the light falls that is drawn where they are said to.
    int touches = 0;
    double touch_mean_mm = 0.0, touch_p95_mm = 0.0;
};

/// Throws Error where the program fails or says that it is not calibrated.
ProjectorScore run_projector(const ProjectorRun& run);

}  // namespace touchstone
