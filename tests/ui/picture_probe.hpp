#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "platform/display/picture.hpp"
#include "ui/style.hpp"

namespace touchstone {

/// Helpers that look at what a display showed.
inline style::Color color_at(const Picture& picture, int x_px, int y_px) {
    const std::uint8_t* p =
        &picture.rgba.at(4 * (static_cast<std::size_t>(y_px) * static_cast<std::size_t>(picture.width_px) +
                              static_cast<std::size_t>(x_px)));
    return {p[0], p[1], p[2], p[3]};
}

/// Largest difference of a channel, of 255.
inline int difference(style::Color a, style::Color b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Calls visit(x_px, y_px) for each pixel that differs by more than `tolerance` of 255.
template <typename Visit>
void for_each_difference(const Picture& a, const Picture& b, int tolerance, Visit visit) {
    for (int y = 0; y < a.height_px; ++y)
        for (int x = 0; x < a.width_px; ++x)
            if (difference(color_at(a, x, y), color_at(b, x, y)) > tolerance) visit(x, y);
}

inline int count_differences(const Picture& a, const Picture& b, int tolerance) {
    int count = 0;
    for_each_difference(a, b, tolerance, [&count](int, int) { ++count; });
    return count;
}

}  // namespace touchstone
