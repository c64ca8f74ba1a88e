#pragma once

#include <Eigen/Geometry>

#include "platform/openni2_drivers/simulator/triangle_mesh.hpp"

namespace touchstone::sim {

/// Exact distance from points to a mesh, by a tree of boxes: about a microsecond or two a query.
class MeshDistance {
  public:
    struct Nearest {
        double distance_m = 0.0;  ///< not signed
        Eigen::Vector3d point = Eigen::Vector3d::Zero();
        std::size_t triangle = 0;  ///< index in the mesh
    };

    /// Copies what it needs of the mesh. Throws std::invalid_argument where there is no triangle.
    explicit MeshDistance(const TriangleMesh& mesh);

    /// In the frame of the mesh, metres. May be called from several threads.
    Nearest nearest(const Eigen::Vector3d& point) const;
    double distance_m(const Eigen::Vector3d& point) const { return nearest(point).distance_m; }

  private:
    struct Corners {
        Eigen::Vector3d a, b, c;
        std::size_t number;
        Eigen::Vector3d middle3() const { return a + b + c; }  ///< three times the middle
    };
    /// A leaf holds `count` triangles from `first`; an inner node has count 0 and the children first and
    /// first + 1.
    struct Node {
        Eigen::AlignedBox3d box;
        std::size_t first = 0;
        std::size_t count = 0;
    };

    std::size_t best_half(std::size_t begin, std::size_t end);
    void split(std::size_t node, std::size_t begin, std::size_t end);
    void search(std::size_t node, const Eigen::Vector3d& point, double& nearest2, Nearest& found) const;

    std::vector<Corners> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace touchstone::sim
