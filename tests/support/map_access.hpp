#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/map_shape.hpp"
#include "platform/opencl/buffer.hpp"

namespace touchstone::test {

/// A row-major picture laid into a padded map; the padding is 0.
template <class T>
std::vector<T> padded(const MapShape& shape, std::span<const T> picture) {
    std::vector<T> map(map_pixels(shape), T{});
    for (int y = 0; y < shape.height_px; ++y) {
        for (int x = 0; x < shape.width_px; ++x) {
            map[map_index(shape, x, y)] = picture[static_cast<std::size_t>(y * shape.width_px + x)];
        }
    }
    return map;
}

/// Plane `plane` of a map without its padding, row-major.
template <class T>
std::vector<T> cropped(const MapShape& shape, const std::vector<T>& map, std::size_t plane = 0) {
    std::vector<T> picture;
    for (int y = 0; y < shape.height_px; ++y) {
        for (int x = 0; x < shape.width_px; ++x)
            picture.push_back(map[plane * map_pixels(shape) + map_index(shape, x, y)]);
    }
    return picture;
}

}  // namespace touchstone::test
