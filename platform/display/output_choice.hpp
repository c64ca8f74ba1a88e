#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "platform/display/picture.hpp"

namespace touchstone {

struct ScreenMode {
    PixelSize size;
    int rate_hz = 0;  ///< 0: whichever, or not known
    bool operator==(const ScreenMode&) const = default;
};

/// A screen or projector that is connected.
struct Output {
    std::string name;  ///< its connector, its model or both
    ScreenMode own;    ///< in which it is now, or which it likes best
    std::vector<ScreenMode> modes;
};

/// "1280x800@60", or "1280x800" where the rate is not known.
std::string to_text(const ScreenMode& mode);
/// Reads what to_text writes; nothing for any other text.
std::optional<ScreenMode> parse_screen_mode(std::string_view text);

/// One that has all of `wanted`, else one whose name has it in it, upper or lower case; for "" the last one,
/// as window systems list the primary one first. Nothing where there is none.
std::optional<std::size_t> find_output(std::span<const Output> outputs, std::string_view wanted);
/// As find_output; throws Error{unavailable} that says which outputs there are.
const Output& choose_output(std::span<const Output> outputs, std::string_view wanted);
/// The mode of an output for "1280x800@60", for "1280x800" its fastest, for "" its own. Throws
/// Error{configuration} for a text that is no mode and for a mode that the output does not have.
ScreenMode choose_mode(const Output& output, std::string_view wanted);

/// "HDMI-A-1 (1920x1080@60; 1280x800@60, 1024x768@60), DP-1 (1280x720@60)": its own mode first.
std::string list_text(std::span<const Output> outputs);

}  // namespace touchstone
