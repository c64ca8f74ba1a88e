#include "app/command_arguments.hpp"

#include <set>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

/// Nothing for the empty word.
std::optional<DisplayKind> to_display(const std::string& word) {
    if (word.empty()) return std::nullopt;
    if (word == "headless") return DisplayKind::headless;
    return word == "window" ? DisplayKind::window : DisplayKind::projector;
}

std::optional<std::string> if_given(const std::string& text) {
    return text.empty() ? std::nullopt : std::optional(text);
}

Config to_config(const SourceArguments& arguments) {
    Config config;
    if (!arguments.config_file.empty()) load_config(arguments.config_file, config);
    if (!arguments.sensor.empty()) {
        config.sensor_uri = arguments.sensor;
        config.sensor_named_in.clear();
    }
    BackgroundConfig& background = config.interaction.background;
    if (arguments.voxels) background.volume.size_vox = *arguments.voxels;
    if (arguments.side_m) {
        background.volume.side_m = *arguments.side_m;
        background.fit_side = false;
    }
    return config;
}

std::optional<Pace> to_pace(const SourceArguments& arguments) {
    if (arguments.pace.empty()) return std::nullopt;
    return arguments.pace == "step" ? Pace::step : Pace::live;
}

/// But the areas, which are shown, and the log of touches, which is named on the command line.
void leave_files(Config& config) {
    for (std::string* file :
         {&config.scan_file, &config.bias_file, &config.display.painting_file, &config.projector.file,
          &config.fault_reports.dir, &config.interaction.background.objects.export_dir})
        file->clear();
}

/// Results written over each other would be lost.
void check_files_differ(const ModelArguments& arguments) {
    std::set<std::string> files;
    for (const std::string& file : {arguments.scan, arguments.mesh, arguments.trajectory}) {
        if (!file.empty() && !files.insert(file).second)
            throw Error(ExitStatus::usage,
                        file + " is named for two results; name a file for each; see touchstone --help");
    }
}

}  // namespace

std::vector<std::string> display_words() { return {"headless", "window", "projector"}; }

CalibrateOptions to_calibrate_options(const CalibrateArguments& arguments) {
    CalibrateOptions options;
    options.config = to_config(arguments.source);
    options.pace = to_pace(arguments.source);
    options.display = to_display(arguments.display);
    if (arguments.method == "touch") options.method = CalibrationMethod::touch;
    options.json_file = if_given(arguments.json);
    return options;
}

RunOptions to_run_options(const RunArguments& arguments) {
    RunOptions options;
    options.config = to_config(arguments.source);
    options.keeps_nothing = arguments.keep_nothing;
    if (options.keeps_nothing) leave_files(options.config);
    options.pace = to_pace(arguments.source);
    options.frames = arguments.source.frames;
    if (!arguments.scene.empty()) options.config.display.scene = arguments.scene;
    options.display = to_display(arguments.display);
    options.events_file = if_given(arguments.events);
    options.maps_dir = if_given(arguments.maps);
    options.shots_dir = if_given(arguments.shots);
    return options;
}

ScanOptions to_scan_options(const ModelArguments& arguments) {
    check_files_differ(arguments);
    ScanOptions options;
    options.config = to_config(arguments.source);
    options.pace = to_pace(arguments.source);
    options.frames = arguments.source.frames;
    options.scan_file = arguments.scan;
    options.mesh_file = if_given(arguments.mesh);
    return options;
}

TrackOptions to_track_options(const ModelArguments& arguments) {
    check_files_differ(arguments);
    TrackOptions options;
    options.config = to_config(arguments.source);
    options.pace = to_pace(arguments.source);
    options.frames = arguments.source.frames;
    options.trajectory_file = if_given(arguments.trajectory);
    options.mesh_file = if_given(arguments.mesh);
    options.scan_file = if_given(arguments.scan);
    options.voxels = options.config.interaction.background.volume.size_vox;
    if (arguments.source.side_m) options.side_m = *arguments.source.side_m;
    return options;
}

RecordOptions to_record_options(const RecordArguments& arguments) {
    return {to_config(arguments.source), to_pace(arguments.source), arguments.source.frames, arguments.color,
            arguments.oni};
}

BenchOptions to_bench_options(const BenchArguments& arguments) {
    BenchOptions options;
    options.config = to_config(arguments.source);
    options.pace = to_pace(arguments.source).value_or(Pace::step);
    options.moving = arguments.moving;
    options.frames = arguments.source.frames.value_or(options.frames);
    options.voxels = options.config.interaction.background.volume.size_vox;
    if (arguments.source.side_m) options.side_m = *arguments.source.side_m;
    options.json_file = if_given(arguments.json);
    options.display = to_display(arguments.display);
    return options;
}

NoticeOptions to_notice_options(const NoticeArguments& arguments) {
    NoticeOptions options;
    try {
        if (!arguments.config_file.empty()) load_config(arguments.config_file, options.config);
    } catch (const Error&) {
        options.config = {};
    }
    options.display = to_display(arguments.display);
    options.seconds = arguments.seconds;
    options.words = arguments.words;
    return options;
}

ResetOptions to_reset_options(const std::string& config_file) {
    ResetOptions options;
    load_config(config_file, options.config);
    return options;
}

}  // namespace touchstone
