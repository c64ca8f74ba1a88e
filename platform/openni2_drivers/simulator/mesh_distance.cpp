#include "platform/openni2_drivers/simulator/mesh_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace touchstone::sim {
namespace {

using Point = Eigen::Vector3d;

constexpr std::size_t leaf_triangles = 4;

/// Nearest point of the segment from a to b; a where both are one point.
Point nearest_on_segment(const Point& p, const Point& a, const Point& b) {
    const Point along = b - a;
    const double length2 = along.squaredNorm();
    if (length2 == 0.0) return a;
    return a + std::clamp(along.dot(p - a) / length2, 0.0, 1.0) * along;
}

/// The foot of the perpendicular where it is inside, else the nearest point of the three sides.
Point nearest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
    const Point normal = (b - a).cross(c - a);
    const double area2 = normal.squaredNorm();
    const auto left_of = [&](const Point& from, const Point& to) {
        return normal.dot((to - from).cross(p - from)) >= 0.0;
    };
    if (area2 > 0.0 && left_of(a, b) && left_of(b, c) && left_of(c, a))
        return p - normal.dot(p - a) / area2 * normal;
    Point best = nearest_on_segment(p, a, b);
    for (const Point& other : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)})
        if ((p - other).squaredNorm() < (p - best).squaredNorm()) best = other;
    return best;
}

template <class Corners>
void extend(Eigen::AlignedBox3d& box, const Corners& triangle) {
    box.extend(triangle.a).extend(triangle.b).extend(triangle.c);
}

double surface(const Eigen::AlignedBox3d& box) {
    const Point sides = box.sizes();
    return sides.x() * sides.y() + sides.y() * sides.z() + sides.z() * sides.x();
}

}  // namespace

MeshDistance::MeshDistance(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) throw std::invalid_argument("MeshDistance: the mesh has no triangle");
    triangles_.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles)
        triangles_.push_back({mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
                              mesh.vertices[c].cast<double>(), triangles_.size()});
    nodes_.emplace_back();
    split(0, 0, triangles_.size());
}

/// Sorts the triangles and gives where to part them, so that the boxes on both sides, each weighed by its
/// number of triangles, have the least surface: a wall stays apart from the things before it.
std::size_t MeshDistance::best_half(std::size_t begin, std::size_t end) {
    const auto from = triangles_.begin() + static_cast<std::ptrdiff_t>(begin);
    const std::size_t count = end - begin;
    std::vector<double> left(count);
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = count / 2;
    Eigen::Index best_axis = 0;
    const auto sort_along = [&](Eigen::Index axis) {
        std::sort(from, from + static_cast<std::ptrdiff_t>(count),
                  [axis](const Corners& one, const Corners& other) {
                      const double difference = one.middle3()[axis] - other.middle3()[axis];
                      return difference != 0.0 ? difference < 0.0 : one.number < other.number;
                  });
    };
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        sort_along(axis);
        Eigen::AlignedBox3d box;
        for (std::size_t i = 0; i < count; ++i) {
            extend(box, triangles_[begin + i]);
            left[i] = surface(box) * static_cast<double>(i + 1);
        }
        box.setEmpty();
        for (std::size_t i = count - 1; i > 0; --i) {
            extend(box, triangles_[begin + i]);
            const double cost = left[i - 1] + surface(box) * static_cast<double>(count - i);
            if (cost >= least) continue;
            least = cost;
            best = i;
            best_axis = axis;
        }
    }
    if (best_axis != 2) sort_along(best_axis);
    return begin + best;
}

void MeshDistance::split(std::size_t node, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) extend(nodes_[node].box, triangles_[i]);
    if (end - begin <= leaf_triangles) {
        nodes_[node].first = begin;
        nodes_[node].count = end - begin;
        return;
    }
    const std::size_t half = best_half(begin, end);
    const std::size_t children = nodes_.size();
    nodes_[node].first = children;
    nodes_.resize(children + 2);
    split(children, begin, half);
    split(children + 1, half, end);
}

MeshDistance::Nearest MeshDistance::nearest(const Eigen::Vector3d& point) const {
    Nearest found;
    double nearest2 = std::numeric_limits<double>::infinity();
    search(0, point, nearest2, found);
    found.distance_m = std::sqrt(nearest2);
    return found;
}

void MeshDistance::search(std::size_t node, const Eigen::Vector3d& point, double& nearest2,
                          Nearest& found) const {
    const Node& here = nodes_[node];
    for (std::size_t i = here.first; i < here.first + here.count; ++i) {
        const Corners& t = triangles_[i];
        const Point on = nearest_on_triangle(point, t.a, t.b, t.c);
        const double distance2 = (point - on).squaredNorm();
        if (distance2 >= nearest2) continue;
        nearest2 = distance2;
        found.point = on;
        found.triangle = t.number;
    }
    if (here.count > 0) return;
    std::size_t near = here.first;
    std::size_t far = near + 1;
    double near2 = nodes_[near].box.squaredExteriorDistance(point);
    double far2 = nodes_[far].box.squaredExteriorDistance(point);
    if (far2 < near2) {
        std::swap(near, far);
        std::swap(near2, far2);
    }
    if (near2 < nearest2) search(near, point, nearest2, found);
    if (far2 < nearest2) search(far, point, nearest2, found);
}

}  // namespace touchstone::sim
