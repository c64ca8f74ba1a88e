#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace touchstone {

/// A virtual thing: triangles with a normal and a colour for each corner. It stands upright along +y on y =
/// 0, its middle over the origin, and is 1 high; metres come with its pose.
struct MeshModel {
    struct Corner {
        Eigen::Vector3f position;
        Eigen::Vector3f normal;  ///< length 1
        std::array<std::uint8_t, 4> rgba;
    };
    std::vector<Corner> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Moved and scaled to stand as above; normals get their length. One without height stays as it is, scaled by
/// its width.
MeshModel standing(MeshModel model);

/// A vase, turned on a lathe, glazed in two colours.
MeshModel make_vase();

}  // namespace touchstone
