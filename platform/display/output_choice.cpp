#include "platform/display/output_choice.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

constexpr int most_px = 16384, most_hz = 1000;

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char sign) { return static_cast<char>(std::tolower(sign)); });
    return lower;
}

/// Takes a number from 1 to `most` off the front of a text.
std::optional<int> take_number(std::string_view& text, int most) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || number < 1 || number > most) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

bool take_sign(std::string_view& text, char sign) {
    if (!text.starts_with(sign)) return false;
    text.remove_prefix(1);
    return true;
}

std::string all_modes(const Output& output) {
    std::string text = to_text(output.own);
    const char* between = "; ";
    for (const ScreenMode& mode : output.modes) {
        if (mode == output.own) continue;
        text += between + to_text(mode);
        between = ", ";
    }
    return text;
}

}  // namespace

std::string to_text(const ScreenMode& mode) {
    const std::string size = std::to_string(mode.size.width_px) + "x" + std::to_string(mode.size.height_px);
    return mode.rate_hz > 0 ? size + "@" + std::to_string(mode.rate_hz) : size;
}

std::optional<ScreenMode> parse_screen_mode(std::string_view text) {
    const auto width_px = take_number(text, most_px);
    if (!width_px || !take_sign(text, 'x')) return std::nullopt;
    const auto height_px = take_number(text, most_px);
    if (!height_px) return std::nullopt;
    const ScreenMode any_rate{{*width_px, *height_px}, 0};
    if (text.empty()) return any_rate;
    const auto rate_hz = take_sign(text, '@') ? take_number(text, most_hz) : std::nullopt;
    if (!rate_hz || !text.empty()) return std::nullopt;
    return ScreenMode{any_rate.size, *rate_hz};
}

std::optional<std::size_t> find_output(std::span<const Output> outputs, std::string_view wanted) {
    if (outputs.empty()) return std::nullopt;
    if (wanted.empty()) return outputs.size() - 1;
    const std::string part = lower_case(wanted);
    std::optional<std::size_t> found;
    for (std::size_t i = outputs.size(); i-- > 0;) {
        const std::string name = lower_case(outputs[i].name);
        if (name == part) return i;
        if (name.find(part) != std::string::npos) found = i;
    }
    return found;
}

const Output& choose_output(std::span<const Output> outputs, std::string_view wanted) {
    if (const auto found = find_output(outputs, wanted)) return outputs[*found];
    if (outputs.empty())
        throw Error(ExitStatus::unavailable,
                    "no screen or projector is connected; connect one, switch it on");
    throw Error(ExitStatus::unavailable,
                "no output \"" + std::string(wanted) + "\" is connected; there is " + list_text(outputs));
}

ScreenMode choose_mode(const Output& output, std::string_view wanted) {
    if (wanted.empty()) return output.own;
    const auto mode = parse_screen_mode(wanted);
    if (!mode) {
        throw Error(ExitStatus::configuration, "display.mode \"" + std::string(wanted) +
                                                   "\" is no WIDTHxHEIGHT@HERTZ, e.g. 1280x800@60");
    }
    std::optional<ScreenMode> best;
    for (const ScreenMode& has : output.modes) {
        const bool fits = has.size == mode->size && (mode->rate_hz == 0 || has.rate_hz == mode->rate_hz);
        if (fits && (!best || has.rate_hz > best->rate_hz)) best = has;
    }
    if (best) return *best;
    throw Error(ExitStatus::configuration, "output " + output.name + " has no mode " + std::string(wanted) +
                                               "; it has " + all_modes(output));
}

std::string list_text(std::span<const Output> outputs) {
    std::string text;
    for (const Output& output : outputs)
        text += (text.empty() ? "" : ", ") + output.name + " (" + all_modes(output) + ")";
    return text;
}

}  // namespace touchstone
