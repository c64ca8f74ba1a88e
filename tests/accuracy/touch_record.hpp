#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <vector>

namespace touchstone {

/// A fingertip of the simulated table in one frame.
struct TrueTip {
    int hand = 0;
    int finger = 0;
    double gap_mm = 0.0;                ///< of the pad from the surface
    std::array<double, 3> camera_mm{};  ///< camera frame: the point on the surface under the pad
};

/// The truth of a simulated table: the tips of each frame from 0 on.
struct TouchTruth {
    double fps = 30.0;
    std::vector<std::vector<TrueTip>> tips;
};

struct LoggedTouch {
    int id = 0;
    std::array<double, 3> camera_mm{};
};

/// Touches that are down, by frame number. Frames that the log does not name have none.
using TouchLog = std::map<int, std::vector<LoggedTouch>>;

/// Reads `truth=FILE` of the simulator. Throws Error{no_input} or Error{bad_data}.
TouchTruth read_touch_truth(const std::filesystem::path& path);
/// Reads the event log of `run --events`. Throws Error{no_input} or Error{bad_data}.
TouchLog read_touch_log(const std::filesystem::path& path);

}  // namespace touchstone
