#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace touchstone {

struct HeightMinimaConfig {
    float highest_m =
        0.168f;  ///< minima above it are of no interest: 150 mm under the pad and a finger's thickness
    float prominence_m = 0.008f;  ///< by how much the surface rises around a minimum, five sigma_z at 1 m
    int least_pixels = 12;        ///< of a minimum's basin
};

/// A low end of the foreground: a local minimum of height that stands out.
struct HeightMinimum {
    int index = 0;   ///< of its lowest pixel
    int object = 0;  ///< the connected part of the foreground it belongs to, 0-based
};

struct HeightMinima {
    std::vector<HeightMinimum> minima;
    std::vector<int> object_pixels;  ///< number of pixels of each object
};

/// Minima of a width x height picture of heights in metres; pixels with `member` 0 are left out. Grows the
/// basins of all minima together in order of height, as a flood would: where two meet, the shallower one
/// counts if it was deep enough.
HeightMinima find_height_minima(std::span<const float> height_m, std::span<const std::uint8_t> member,
                                int width_px, const HeightMinimaConfig& config);

}  // namespace touchstone
