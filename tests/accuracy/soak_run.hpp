#pragma once

#include <string>
#include <vector>

#include "tests/accuracy/touch_score.hpp"

namespace touchstone {

/// A simulated table at live pace for hours: visitors who come and go, and a camera that fails.
struct SoakRun {
    std::string program;
    std::string scene = "mixed";
    std::string config;  ///< file for the program; empty: none
    double minutes = 20.0;
    int seed = 101;
    double pause_s = 15.0;         ///< between two visits of a hand, on average
    double faults_every_s = 90.0;  ///< on average; 0: none
    bool shows_progress = false;   ///< on standard error
};

/// One look at the process and at what it did since the last one.
struct SoakSample {
    double at_s = 0.0;  ///< since the first live frame
    double resident_mb = 0.0;
    int open_files = 0;
    int frames = 0;
    double worst_lag_ms = 0.0;
};

/// Frames are counted while the camera is there, from the first live one on.
struct SoakScore {
    double seconds = 0.0;
    int frames = 0;
    int dropped = 0;  ///< that the camera gave and nobody processed, outside faults
    int faults = 0, restarts = 0;
    double rate_hz = 0.0;  ///< of the frames processed, by the wall clock, over the time without faults
    /// From when a frame could be read to its line in the event log: more than the quickest of its time.
    double median_lag_ms = 0.0, p99_lag_ms = 0.0, worst_lag_ms = 0.0;
    double start_mb = 0.0, end_mb = 0.0;  ///< resident, the mean of minute 2 and of the last one
    int start_files = 0, end_files = 0;
    TouchScore touches;  ///< outside faults
    std::vector<SoakSample> samples;
    int exit_status = -1;  ///< after SIGTERM
    double dropped_share() const {
        return frames + dropped == 0 ? 0.0 : static_cast<double>(dropped) / (frames + dropped);
    }
};

/// Throws std::runtime_error where the program ends by itself or is silent for a minute.
SoakScore run_soak(const SoakRun& run);

/// Truth and log without what happened while frames were missing: `gaps` are pairs of the last frame before
/// and the first after. Both lose the frames from 45 before to 45 after.
void leave_out_gaps(const std::vector<std::pair<int, int>>& gaps, TouchTruth& truth, TouchLog& log);

/// For people, a line a figure.
std::string text_of(const SoakScore& score);
/// What gnuplot makes the chart of: frame rate, lag, memory and open files over the hours.
std::string gnuplot_script(const SoakScore& score, const std::string& png);

}  // namespace touchstone
