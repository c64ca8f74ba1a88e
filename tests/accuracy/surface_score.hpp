#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "pipeline/surface_mesh.hpp"

namespace touchstone {

/// Points on a mesh, evenly by area; equal meshes give equal points.
std::vector<Eigen::Vector3f> sample_surface(const SurfaceMesh& mesh, std::size_t count);

/// The mesh, moved.
SurfaceMesh transformed(const SurfaceMesh& mesh, const Eigen::Isometry3f& T);

/// T_truth_mesh, from a start that is a few centimetres and degrees away at most, that lays the mesh on the
/// truth: iterated closest points, point to plane. Parts of either that the other has not are left out as
/// outliers. Directions that the shape leaves open stay as they are.
Eigen::Isometry3f align_to_truth(const SurfaceMesh& mesh, const SurfaceMesh& truth,
                                 const Eigen::Isometry3f& T_truth_mesh);

/// How a reconstruction compares with the true surface; both in the same frame. Lengths in millimetres.
struct SurfaceScore {
    // Accuracy: from points of the reconstruction to the truth.
    double mean_mm = 0.0, rms_mm = 0.0, median_mm = 0.0, percentile_95_mm = 0.0;
    double share_over_5_mm = 0.0, share_over_10_mm = 0.0, share_over_50_mm = 0.0;
    // Completeness: share of points of the truth this close to the reconstruction.
    double completeness_5_mm = 0.0, completeness_10_mm = 0.0;
    std::size_t samples = 0;  ///< points on each
    std::size_t triangles = 0;
};

SurfaceScore score_surface(const SurfaceMesh& mesh, const SurfaceMesh& truth, std::size_t samples = 200'000);

std::string json_of(const SurfaceScore& score);
/// One line for people.
std::string line_of(const SurfaceScore& score);

}  // namespace touchstone
