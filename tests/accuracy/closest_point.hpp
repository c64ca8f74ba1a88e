#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/surface_mesh.hpp"

namespace touchstone {

struct ClosestPoint {
    Eigen::Vector3f point_m = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of its triangle; zero where it has no area
    float distance_m = 0.0f;
};

/// Exact distances from points to the triangles of a mesh, by a tree of boxes.
class DistanceToMesh {
  public:
    /// The mesh must have triangles; it is copied.
    explicit DistanceToMesh(const SurfaceMesh& mesh);
    ClosestPoint closest(const Eigen::Vector3f& p_m) const;

  private:
    using Box = Eigen::AlignedBox3f;
    using Corners = std::array<Eigen::Vector3f, 3>;
    /// A leaf has triangles [first, first + count); an inner node (count 0) children at `first` and `first`
    /// + 1.
    struct Node {
        Box box;
        std::uint32_t first = 0, count = 0;
    };
    void build(std::size_t node, std::size_t first, std::size_t last);

    std::vector<Corners> triangles_;
    std::vector<Node> nodes_;
};

/// Nearest point of a triangle. Ericson, Real-Time Collision Detection, 5.1.5.
Eigen::Vector3f closest_on_triangle(const Eigen::Vector3f& p, const std::array<Eigen::Vector3f, 3>& triangle);

}  // namespace touchstone
