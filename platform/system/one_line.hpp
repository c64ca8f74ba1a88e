#pragma once

#include <algorithm>
#include <string>

namespace touchstone {

/// What somebody else wrote, for a message of one line: its control characters are question marks.
inline std::string one_line(std::string text) {
    const auto is_control = [](char letter) {
        const auto code = static_cast<unsigned char>(letter);
        return code < ' ' || code == 0x7f;
    };
    std::ranges::replace_if(text, is_control, '?');
    return text;
}

}  // namespace touchstone
