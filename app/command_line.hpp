#pragma once

#include <optional>
#include <string>
#include <variant>

#include "app/config.hpp"
#include "platform/openni2_drivers/common/frame_source.hpp"

namespace touchstone {

enum class DisplayKind {
    headless,
    window,
    projector,  ///< all of a screen
};

/// What `touchstone run` was asked to do, configuration file included.
struct RunOptions {
    Config config;
    std::optional<Pace> pace;                ///< else the source's own
    std::optional<DisplayKind> display;      ///< else a window where there is a desktop
    std::optional<std::string> events_file;  ///< "-" is standard output
    std::optional<std::string> maps_dir;
    std::optional<std::string> shots_dir;
    std::optional<int> frames;   ///< end after so many processed frames
    bool keeps_nothing = false;  ///< no file that the configuration names is written
};

/// `touchstone scan`: a fixed camera's surroundings, once.
struct ScanOptions {
    Config config;
    std::optional<Pace> pace;
    std::optional<int> frames;
    std::string scan_file;
    std::optional<std::string> mesh_file;
};

/// `touchstone track`: a moving camera, or an object turned by hand before a fixed one.
struct TrackOptions {
    Config config;             ///< sensor_uri is not empty
    std::optional<Pace> pace;  ///< else the source's own
    std::optional<std::string> trajectory_file, mesh_file, scan_file;
    int voxels = 512;
    float side_m = 4.8f;
    std::optional<int> frames;
};

/// `touchstone record`: what the camera gives, in a file that is a sensor itself.
struct RecordOptions {
    Config config;
    std::optional<Pace> pace;  ///< else the source's own
    std::optional<int> frames;
    bool with_color = false;
    std::string oni_file;
};

/// `touchstone bench`: how long the frames of `run`, or of `track`, take.
struct BenchOptions {
    Config config;
    Pace pace = Pace::step;                ///< as fast as frames are taken
    bool moving = false;                   ///< the loop of `track`
    int frames = 600;                      ///< live ones; the scan is not counted
    int voxels = 512;                      ///< of a moving camera
    float side_m = 4.8f;                   ///< the same
    std::optional<std::string> json_file;  ///< "-" is standard output
    std::optional<DisplayKind> display;    ///< its pictures are measured too; not with `moving`
};

enum class CalibrationMethod { touch, graycode };

/// `touchstone calibrate`: which pixel of the projector lights which place.
struct CalibrateOptions {
    Config config;
    std::optional<Pace> pace;            ///< else the source's own
    std::optional<DisplayKind> display;  ///< else as RunOptions
    CalibrationMethod method = CalibrationMethod::graycode;
    std::optional<std::string> json_file;  ///< "-" is standard output
};

/// `touchstone check`: is this machine ready?
struct CheckOptions {
    std::string config_file;  ///< empty: the defaults. Read by the check: a bad one is a finding.
    bool json = false;
};

/// `touchstone notice`: words on the display, where the table itself cannot run.
struct NoticeOptions {
    Config config;
    std::optional<DisplayKind> display;  ///< else as RunOptions
    double seconds = 300.0;
    std::string words;
};

/// `touchstone reset`: back to the first start.
struct ResetOptions {
    Config config;
};

/// Text for standard output and then success: --help, --version, --print-config.
struct PrintedText {
    std::string text;
};

using Command = std::variant<RunOptions, ScanOptions, TrackOptions, CalibrateOptions, RecordOptions,
                             BenchOptions, CheckOptions, NoticeOptions, ResetOptions, PrintedText>;

/// Throws Error{usage} for what is not understood, Error{configuration or no_input} for the configuration
/// file.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace touchstone
