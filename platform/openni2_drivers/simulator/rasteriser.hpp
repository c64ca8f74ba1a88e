#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "kernels/shared_types.h"
#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

namespace touchstone::sim {

/// What a pinhole camera sees of a mesh, row-major.
struct Raster {
    static constexpr float nothing_m = std::numeric_limits<float>::infinity();
    static constexpr std::int32_t no_triangle = -1;
    std::vector<float> depth_m;          ///< z; nothing_m where no surface is seen
    std::vector<std::int32_t> triangle;  ///< index in the mesh, or no_triangle
};

/// Draws by z-buffer: one sample at the centre of each pixel (whole numbers), where 1/z is exact to the
/// rounding of a float. A pixel on an edge that two triangles share is always drawn. Nearer than 50 mm
/// nothing is seen. T_c_s takes points of the mesh to the camera frame.
void rasterise(const TriangleMesh& mesh, const Eigen::Isometry3d& T_c_s, const Intrinsics& intrinsics,
               Raster& raster);

/// Colours the pixels where something is seen, 3 bytes each, of a picture that is made black where it has no
/// pixels yet: each triangle's albedo, a soft pattern that lies in the mesh, and the room's light on the flat
/// normal. T_s_c is the camera's pose in the frame of the mesh, R_w_s turns that frame to the room's, where z
/// is up.
void shade_raster(const Raster& raster, const TriangleMesh& mesh, const Eigen::Isometry3d& T_s_c,
                  const Eigen::Matrix3d& R_w_s, const Intrinsics& intrinsics,
                  std::vector<std::uint8_t>& color_rgb);

}  // namespace touchstone::sim
