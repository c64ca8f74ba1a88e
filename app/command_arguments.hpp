#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command_line.hpp"

namespace touchstone {

/// What the sub-commands have in common.
struct SourceArguments {
    std::string sensor, pace, config_file;
    std::optional<int> frames, voxels;
    std::optional<float> side_m;
};

struct RunArguments {
    SourceArguments source;
    std::string display, scene, events, maps, shots;
    bool print_config = false, keep_nothing = false;
};

/// Files that scan and track write.
struct ModelArguments {
    SourceArguments source;
    std::string scan, mesh, trajectory;
};

struct RecordArguments {
    SourceArguments source;
    std::string oni;
    bool color = false;
};

struct CalibrateArguments {
    SourceArguments source;
    std::string method, display, json;
};

struct BenchArguments {
    SourceArguments source;
    std::string json, display;
    bool moving = false;
};

struct NoticeArguments {
    std::string config_file, display, words;
    double seconds = 300.0;
};

std::vector<std::string> display_words();

/// Each throws Error{usage} for words that contradict one another, Error{configuration or no_input} for the
/// configuration file.
RunOptions to_run_options(const RunArguments& arguments);
ScanOptions to_scan_options(const ModelArguments& arguments);
TrackOptions to_track_options(const ModelArguments& arguments);
CalibrateOptions to_calibrate_options(const CalibrateArguments& arguments);
RecordOptions to_record_options(const RecordArguments& arguments);
BenchOptions to_bench_options(const BenchArguments& arguments);
/// A configuration file that cannot be read is passed over: the words are to be shown all the same.
NoticeOptions to_notice_options(const NoticeArguments& arguments);
ResetOptions to_reset_options(const std::string& config_file);

}  // namespace touchstone
