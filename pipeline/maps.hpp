#pragma once

#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"
#include "pipeline/map_shape.hpp"
#include "platform/opencl/buffer.hpp"

namespace touchstone {

/// A map as a picture without padding, row-major. Waits for the device.
template <class T>
std::vector<T> without_padding(const Buffer<T>& map, const MapShape& shape) {
    const auto values = map.map_read();
    std::vector<T> picture;
    picture.reserve(static_cast<std::size_t>(shape.width_px) * static_cast<std::size_t>(shape.height_px));
    for (int y = 0; y < shape.height_px; ++y) {
        const T* const row = &values[map_index(shape, 0, y)];
        picture.insert(picture.end(), row, row + shape.width_px);
    }
    return picture;
}

/// What the camera sees now (Fig 11a). All in the camera frame c, metres, on the device. A missing pixel has
/// depth 0 and the zero vector as its normal. The vertex map is the depth map: v_c(u) = D(u) K^-1 [u, 1]
/// (PAPER.md#5).
struct LiveMaps {
    LiveMaps(const Device& device, const MapShape& map_shape)
        : shape(map_shape),
          depth_m(device, map_pixels(map_shape)),
          filtered_m(device, map_pixels(map_shape)),
          normals_c(device, 3 * map_pixels(map_shape)) {}

    MapShape shape;
    Buffer<float> depth_m;     ///< as measured
    Buffer<float> filtered_m;  ///< bilateral filter
    Buffer<float> normals_c;   ///< planes x, y, z; unit length, facing the camera
};

/// A raycast of a volume from the camera (Fig 11d): the same conventions as LiveMaps.
struct SurfacePrediction {
    SurfacePrediction(const Device& device, const MapShape& map_shape)
        : shape(map_shape),
          depth_m(device, map_pixels(map_shape)),
          normals_c(device, 3 * map_pixels(map_shape)) {}

    MapShape shape;
    Buffer<float> depth_m;
    Buffer<float> normals_c;
};

}  // namespace touchstone
