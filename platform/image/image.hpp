#pragma once

#include <cstdint>
#include <vector>

namespace touchstone {

/// Row-major picture of 8 bit a channel. Channels: 1 gray, 3 red green blue, 4 red green blue alpha.
struct Image8 {
    int width_px = 0;
    int height_px = 0;
    int channels = 0;
    std::vector<std::uint8_t> pixels;  ///< width x height x channels
};

/// Row-major gray picture of 16 bit a pixel: depth in millimetres, say.
struct Image16 {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint16_t> pixels;  ///< width x height
};

}  // namespace touchstone
