#pragma once

#include "pipeline/surface_mesh.hpp"
#include "platform/openni2_drivers/simulator/mesh_distance.hpp"

namespace touchstone {

struct ClosestPoint {
    Eigen::Vector3f point_m = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of its triangle; zero where it has no area
    double distance_m = 0.0;
};

/// Exact distances to the triangles of a mesh, with the simulator's tree of boxes.
class DistanceToMesh {
  public:
    /// The mesh must have triangles; it is copied.
    explicit DistanceToMesh(const SurfaceMesh& mesh)
        : mesh_{mesh.vertices_g_m, mesh.triangles, {}}, distance_(mesh_) {}

    ClosestPoint closest(const Eigen::Vector3f& p_m) const {
        const auto nearest = distance_.nearest(p_m.cast<double>());
        return {nearest.point.cast<float>(), sim::triangle_normal(mesh_, nearest.triangle),
                nearest.distance_m};
    }

  private:
    sim::TriangleMesh mesh_;
    sim::MeshDistance distance_;
};

}  // namespace touchstone
