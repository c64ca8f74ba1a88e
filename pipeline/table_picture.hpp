#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "pipeline/map_shape.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

/// The maps that fingers are looked for in, mapped to the host for the length of a call. All have the same
/// MapShape; invalid values are those of the maps: depth 0, the zero normal, UNKNOWN_HEIGHT_M.
struct TablePicture {
    Intrinsics intrinsics{};
    MapShape shape{};
    SensorNoise noise{};
    std::span<const float> live_m;        ///< as measured
    std::span<const float> height_m;      ///< of TouchMap
    std::span<const float> background_m;  ///< predicted depth
    std::span<const float> normals_c;     ///< predicted, 3 planes
    std::span<const std::uint8_t> mask;   ///< other than 0: foreground
};

/// A point of the background with its normal; `known` is false where nothing was predicted.
struct SurfacePoint {
    Eigen::Vector3f point_c_m{0.f, 0.f, 0.f};
    Eigen::Vector3f normal_c{0.f, 0.f, 0.f};
    bool known = false;
};

inline std::size_t index_of(const TablePicture& picture, int x, int y) {
    return map_index(picture.shape, x, y);
}
inline bool in_picture(const TablePicture& picture, int x, int y) {
    return x >= 0 && y >= 0 && x < picture.shape.width_px && y < picture.shape.height_px;
}
SurfacePoint background_at(const TablePicture& picture, int x, int y);
/// sigma_z of a measurement at this depth, for a surface that faces the camera.
float sigma_z_m(const SensorNoise& noise, float depth_m);

/// The point of the background nearest to a point in front of it, by search from coarse to fine: also right
/// beside things that stand on the surface, where tangent planes lead astray. Unknown outside the picture.
SurfacePoint foot_point(const TablePicture& picture, const Eigen::Vector3f& point_c_m);

}  // namespace touchstone
