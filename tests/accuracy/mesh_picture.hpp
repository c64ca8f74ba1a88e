#pragma once

#include <Eigen/Core>

#include "pipeline/surface_mesh.hpp"
#include "platform/image/image.hpp"

namespace touchstone {

struct PictureConfig {
    Eigen::Vector3f eye_m = Eigen::Vector3f::Zero();       ///< where the viewer is, in the mesh's frame
    Eigen::Vector3f look_at_m = Eigen::Vector3f::UnitZ();  ///< what is in the middle
    Eigen::Vector3f up = -Eigen::Vector3f::UnitY();
    float field_of_view_rad = 0.7f;  ///< from left to right
    int width_px = 960, height_px = 720;
    bool use_colors = true;  ///< the mesh's, where it has any; else grey
};

/// The whole mesh, seen from a direction (from the mesh to the viewer), filling a picture of the default
/// size.
PictureConfig whole_mesh(const SurfaceMesh& mesh, const Eigen::Vector3f& direction,
                         const Eigen::Vector3f& up = -Eigen::Vector3f::UnitY());

/// A picture to look at: flat shading with the light at the viewer, depth buffer, RGB. Backs of triangles
/// (seen from inside the solid) are red.
Image8 draw_mesh(const SurfaceMesh& mesh, const PictureConfig& config);

}  // namespace touchstone
