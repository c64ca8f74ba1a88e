#pragma once

#include <optional>
#include <string>
#include <variant>

#include "app/config.hpp"
#include "platform/openni2_drivers/common/frame_source.hpp"

namespace touchstone {

enum class DisplayKind { headless, window };

/// What `touchstone run` was asked to do, configuration file included.
struct RunOptions {
    Config config;
    std::optional<Pace> pace;                ///< else the source's own
    std::optional<DisplayKind> display;      ///< else a window where there is a desktop
    std::optional<std::string> events_file;  ///< "-" is standard output
    std::optional<std::string> maps_dir;
    std::optional<std::string> shots_dir;
    std::optional<int> frames;  ///< end after so many processed frames
};

/// Text for standard output and then success: --help, --version, --print-config.
struct PrintedText {
    std::string text;
};

using Command = std::variant<RunOptions, PrintedText>;

/// Throws Error{usage} for what is not understood, Error{configuration or no_input} for the configuration
/// file.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace touchstone
