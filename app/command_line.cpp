#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <limits>
#include <sstream>

#include "app/command_arguments.hpp"
#include "platform/system/error.hpp"
#include "ui/scene_list.hpp"

namespace touchstone {

namespace {

const CLI::Validator not_empty(
    [](const std::string& text) { return text.empty() ? std::string("needs a name") : std::string(); }, "");

template <class Number>
CLI::Validator number_from(Number least, Number most, const std::string& what) {
    const auto complaint = [=](const std::string& text) {
        Number number{};
        const bool is_one = CLI::detail::lexical_cast(text, number) && number >= least && number <= most;
        return is_one ? std::string() : text + " is not " + what;
    };
    return {complaint, ""};
}

const CLI::Validator positive = number_from(1, std::numeric_limits<int>::max(), "a whole number from 1");
const CLI::Validator positive_seconds = number_from(1e-3, 1e9, "a number of seconds above 0");
const CLI::Validator volume_side = number_from(0.2f, 10.0f, "a number of metres from 0.2 to 10");

const CLI::Validator volume_size(
    [](const std::string& text) {
        int voxels = 0;
        const bool number = CLI::detail::lexical_cast(text, voxels);
        return number && voxels >= 64 && voxels <= 1024 && voxels % 8 == 0
                   ? std::string()
                   : text + " is not a multiple of 8 from 64 to 1024";
    },
    "");

CLI::Option* add_camera_options(CLI::App& app, SourceArguments& arguments) {
    CLI::Option* sensor =
        app.add_option("--sensor", arguments.sensor,
                       "PATH.oni, seq:DIR, sim:SCENE?key=value&...; default: the attached camera");
    app.add_option("--pace", arguments.pace, "live or step; step takes every frame in order")
        ->check(CLI::IsMember({"live", "step"}));
    app.add_option("--config", arguments.config_file, "TOML file; see run --print-config");
    return sensor;
}

void add_frames(CLI::App& app, SourceArguments& arguments) {
    app.add_option("--frames", arguments.frames, "end after so many frames")->check(positive);
}

/// Also the volume that its frames are fused into.
CLI::Option* add_source_options(CLI::App& app, SourceArguments& arguments) {
    CLI::Option* sensor = add_camera_options(app, arguments);
    app.add_option("--voxels", arguments.voxels, "along a side of the volume, default 512")
        ->check(volume_size);
    app.add_option("--side", arguments.side_m, "of the volume, metres; default: as seen, track: 4.8")
        ->check(volume_side);
    return sensor;
}

void add_display(CLI::App& app, std::string& display) {
    app.add_option("--display", display,
                   "headless, window, or projector, which fills a screen; default: a window where there is a "
                   "desktop")
        ->check(CLI::IsMember(display_words()));
}

void add_run_options(CLI::App& app, RunArguments& arguments) {
    add_source_options(app, arguments.source);
    add_frames(app, arguments.source);
    add_display(app, arguments.display);
    app.add_option("--scene", arguments.scene, "what the table shows")->check(CLI::IsMember(scene_names()));
    app.add_option("--events", arguments.events, "touches as JSON lines, - for standard output");
    app.add_option("--maps", arguments.maps, "folder for foreground and touch maps, PNG");
    app.add_option("--shots", arguments.shots, "folder for what the display showed, PNG");
    app.add_flag("--keep-nothing", arguments.keep_nothing,
                 "leave scan, calibrations, paintings and reports of the configuration alone");
    app.add_flag("--print-config", arguments.print_config, "print the whole configuration and end");
}

CLI::Option* add_scan_file(CLI::App& app, ModelArguments& arguments) {
    return app.add_option("--scan", arguments.scan, "file for the scan")->check(not_empty);
}

void add_mesh_file(CLI::App& app, ModelArguments& arguments) {
    app.add_option("--mesh", arguments.mesh, "file for the surface: .ply, .obj or .stl")->check(not_empty);
}

CLI::App* add_scan(CLI::App& app, ModelArguments& arguments) {
    CLI::App* scan = app.add_subcommand("scan", "scan what a fixed camera sees, once");
    add_source_options(*scan, arguments.source);
    add_frames(*scan, arguments.source);
    add_scan_file(*scan, arguments)->required();
    add_mesh_file(*scan, arguments);
    return scan;
}

CLI::App* add_track(CLI::App& app, ModelArguments& arguments) {
    CLI::App* track = app.add_subcommand("track", "follow a moving camera, or an object turned by hand");
    add_source_options(*track, arguments.source)
        ->required()
        ->check(not_empty)
        ->description("PATH.oni, seq:DIR, sim:SCENE?key=value&...");
    add_frames(*track, arguments.source);
    track->add_option("--trajectory", arguments.trajectory, "file for the camera's path, TUM format")
        ->check(not_empty);
    add_scan_file(*track, arguments);
    add_mesh_file(*track, arguments);
    return track;
}

CLI::App* add_calibrate(CLI::App& app, CalibrateArguments& arguments) {
    CLI::App* calibrate = app.add_subcommand("calibrate", "find where the projector's picture lies");
    add_source_options(*calibrate, arguments.source);
    calibrate
        ->add_option("--method", arguments.method,
                     "graycode: the colour camera looks at stripes (default); touch: crosses are touched")
        ->check(CLI::IsMember({"graycode", "touch"}));
    add_display(*calibrate, arguments.display);
    calibrate->add_option("--json", arguments.json, "file for the result, - for standard output")
        ->check(not_empty);
    return calibrate;
}

CLI::App* add_record(CLI::App& app, RecordArguments& arguments) {
    CLI::App* record = app.add_subcommand("record", "write what the camera gives to an .oni file");
    add_camera_options(*record, arguments.source);
    add_frames(*record, arguments.source);
    record->add_flag("--color", arguments.color, "colour too, where the camera has it");
    record->add_option("FILE.oni", arguments.oni, "the file")->check(not_empty)->required();
    return record;
}

CLI::App* add_bench(CLI::App& app, BenchArguments& arguments) {
    CLI::App* bench = app.add_subcommand("bench", "how long the frames of run, or of track, take");
    add_source_options(*bench, arguments.source);
    add_frames(*bench, arguments.source);
    bench->add_flag("--moving", arguments.moving, "the loop of track instead of that of run");
    bench->add_option("--json", arguments.json, "file for the figures, - for standard output")
        ->check(not_empty);
    bench
        ->add_option("--display", arguments.display,
                     "headless, window or projector: the time from a frame to its picture, too")
        ->check(CLI::IsMember(display_words()))
        ->excludes("--moving");
    return bench;
}

CLI::App* add_check(CLI::App& app, CheckOptions& options) {
    CLI::App* check = app.add_subcommand("check", "is this machine ready? What is wrong, and what to do");
    check->add_flag("--json", options.json, "as JSON");
    check->add_option("--config", options.config_file, "TOML file to check too");
    return check;
}

CLI::App* add_notice(CLI::App& app, NoticeArguments& arguments) {
    CLI::App* notice = app.add_subcommand("notice", "words on the display, where the table cannot run");
    notice->add_option("WORDS", arguments.words, "what it says")->check(not_empty)->required();
    notice->add_option("--config", arguments.config_file, "TOML file: which output and mode");
    add_display(*notice, arguments.display);
    notice->add_option("--seconds", arguments.seconds, "how long, default 300")->check(positive_seconds);
    return notice;
}

CLI::App* add_reset(CLI::App& app, std::string& config_file) {
    CLI::App* reset = app.add_subcommand(
        "reset", "back to the first start: removes scan, calibrations, painting and reports of faults");
    reset->add_option("--config", config_file, "TOML file that names them; it stays")->required();
    return reset;
}

/// Options of `run` may stand without it; before another sub-command they would be lost.
void check_no_options_before(const CLI::App& app, const std::string& command) {
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() > 0)
            throw Error(ExitStatus::usage, option->get_name() + " goes behind " + command +
                                               "; see touchstone " + command + " --help");
    }
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
    CLI::App app("Touchstone turns any surface under a fixed depth camera into a multi-touch surface",
                 "touchstone");
    app.set_version_flag("--version", TOUCHSTONE_VERSION);
    RunArguments run_arguments;
    ModelArguments model_arguments;
    add_run_options(app, run_arguments);
    add_run_options(*app.add_subcommand("run", "the table (no sub-command means run)"), run_arguments);
    const CLI::App* scan = add_scan(app, model_arguments);
    const CLI::App* track = add_track(app, model_arguments);
    CalibrateArguments calibrate_arguments;
    const CLI::App* calibrate = add_calibrate(app, calibrate_arguments);
    RecordArguments record_arguments;
    const CLI::App* record = add_record(app, record_arguments);
    BenchArguments bench_arguments;
    const CLI::App* bench = add_bench(app, bench_arguments);
    CheckOptions check_options;
    const CLI::App* check = add_check(app, check_options);
    NoticeArguments notice_arguments;
    const CLI::App* notice = add_notice(app, notice_arguments);
    std::string reset_config;
    const CLI::App* reset = add_reset(app, reset_config);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {
        std::ostringstream text, errors;
        app.exit(request, text, errors);
        return PrintedText{text.str()};
    } catch (const CLI::ExtrasError&) {
        throw Error(ExitStatus::usage, fmt::format("not understood: {}; see touchstone --help",
                                                   fmt::join(app.remaining(true), " ")));
    } catch (const CLI::ParseError& error) {
        throw Error(ExitStatus::usage, std::string(error.what()) + "; see touchstone --help");
    }
    for (const CLI::App* command : {scan, track, calibrate, record, bench, check, notice, reset}) {
        if (command->parsed()) check_no_options_before(app, command->get_name());
    }
    if (scan->parsed()) return to_scan_options(model_arguments);
    if (track->parsed()) return to_track_options(model_arguments);
    if (calibrate->parsed()) return to_calibrate_options(calibrate_arguments);
    if (record->parsed()) return to_record_options(record_arguments);
    if (bench->parsed()) return to_bench_options(bench_arguments);
    if (check->parsed()) return check_options;
    if (notice->parsed()) return to_notice_options(notice_arguments);
    if (reset->parsed()) return to_reset_options(reset_config);
    RunOptions options = to_run_options(run_arguments);
    if (run_arguments.print_config) return PrintedText{print_config(options.config)};
    return options;
}

}  // namespace touchstone
