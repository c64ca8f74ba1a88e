#include "app/command_line.hpp"

#include <CLI/CLI.hpp>

#include "platform/system/error.hpp"
#include "ui/scene_list.hpp"

namespace touchstone {

namespace {

struct RunArguments {
    std::string sensor, pace, display, scene, config_file, events, maps, shots;
    int frames = 0;
    bool print_config = false;
};

void add_run_options(CLI::App& app, RunArguments& arguments) {
    app.add_option("--sensor", arguments.sensor,
                   "PATH.oni, seq:DIR, sim:SCENE?key=value&...; default: the attached camera");
    app.add_option("--pace", arguments.pace, "live or step; step takes every frame in order")
        ->check(CLI::IsMember({"live", "step"}));
    app.add_option("--display", arguments.display,
                   "headless or window; default: a window where there is a desktop")
        ->check(CLI::IsMember({"headless", "window"}));
    app.add_option("--scene", arguments.scene, "what the table shows")->check(CLI::IsMember(scene_names()));
    app.add_option("--config", arguments.config_file, "TOML file; see --print-config");
    app.add_option("--events", arguments.events, "touches as JSON lines, - for standard output");
    app.add_option("--maps", arguments.maps, "folder for foreground and touch maps, PNG");
    app.add_option("--shots", arguments.shots, "folder for what the display showed, PNG");
    app.add_option("--frames", arguments.frames, "end after so many frames")->check(CLI::PositiveNumber);
    app.add_flag("--print-config", arguments.print_config, "print the whole configuration and end");
}

std::optional<std::string> if_given(const std::string& text) {
    return text.empty() ? std::nullopt : std::optional(text);
}

RunOptions to_run_options(const RunArguments& arguments) {
    RunOptions options;
    if (!arguments.config_file.empty()) load_config(arguments.config_file, options.config);
    if (!arguments.sensor.empty()) options.config.sensor_uri = arguments.sensor;
    if (!arguments.scene.empty()) options.config.display.scene = arguments.scene;
    if (!arguments.pace.empty()) options.pace = arguments.pace == "step" ? Pace::step : Pace::live;
    if (!arguments.display.empty()) {
        options.display = arguments.display == "window" ? DisplayKind::window : DisplayKind::headless;
    }
    options.events_file = if_given(arguments.events);
    options.maps_dir = if_given(arguments.maps);
    options.shots_dir = if_given(arguments.shots);
    if (arguments.frames > 0) options.frames = arguments.frames;
    return options;
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
    CLI::App app("Touchstone turns any surface under a fixed depth camera into a multi-touch surface",
                 "touchstone");
    app.set_version_flag("--version", TOUCHSTONE_VERSION);
    RunArguments arguments;
    add_run_options(app, arguments);
    CLI::App* run = app.add_subcommand("run", "the table (no sub-command means run)");
    add_run_options(*run, arguments);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {
        std::ostringstream text, errors;
        app.exit(request, text, errors);
        return PrintedText{text.str()};
    } catch (const CLI::ParseError& error) {
        throw Error(ExitStatus::usage, std::string(error.what()) + "; see touchstone --help");
    }
    RunOptions options = to_run_options(arguments);
    if (arguments.print_config) return PrintedText{print_config(options.config)};
    return options;
}

}  // namespace touchstone
