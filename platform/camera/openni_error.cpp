#include "platform/camera/openni_error.hpp"

#include <charconv>

#include "platform/openni2_drivers/common/driver_properties.h"

namespace touchstone {

std::optional<Error> driver_error_in(std::string_view text) {
    constexpr std::string_view prefix = TOUCHSTONE_ERROR_PREFIX;
    const std::size_t start = text.find(prefix);
    if (start == std::string_view::npos) return std::nullopt;
    text.remove_prefix(start + prefix.size());
    text = text.substr(0, text.find(TOUCHSTONE_ERROR_SUFFIX));
    int status = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), status);
    if (code != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.starts_with(' ')) text.remove_prefix(1);
    return Error(static_cast<ExitStatus>(status), std::string(text));
}

std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (!space) {
            line += c;
        } else if (!line.empty() && line.back() != ' ') {
            line += ' ';
        }
    }
    while (line.ends_with(' ')) line.pop_back();
    return line;
}

}  // namespace touchstone
