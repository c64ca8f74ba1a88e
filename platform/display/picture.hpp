#pragma once

#include <cstdint>
#include <vector>

namespace touchstone {

struct PixelSize {
    int width_px = 0;
    int height_px = 0;
    bool operator==(const PixelSize&) const = default;
};

/// What a display showed: RGBA, 8 bits, row-major, top row first.
struct Picture {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgba;
};

}  // namespace touchstone
