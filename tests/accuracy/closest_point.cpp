#include "tests/accuracy/closest_point.hpp"

#include <algorithm>
#include <limits>

namespace touchstone {
namespace {

constexpr std::size_t most_in_a_leaf = 4;

Eigen::Vector3f middle(const std::array<Eigen::Vector3f, 3>& t) { return (t[0] + t[1] + t[2]) / 3.0f; }

}  // namespace

Eigen::Vector3f closest_on_triangle(const Eigen::Vector3f& p,
                                    const std::array<Eigen::Vector3f, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const Eigen::Vector3f ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
                d6 = ac.dot(cp);
    if (d1 <= 0.0f && d2 <= 0.0f) return a;
    if (d3 >= 0.0f && d4 <= d3) return b;
    if (d6 >= 0.0f && d5 <= d6) return c;
    const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return a + d1 / (d1 - d3) * ab;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return a + d2 / (d2 - d6) * ac;
    if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    }
    return a + (vb * ab + vc * ac) / (va + vb + vc);
}

DistanceToMesh::DistanceToMesh(const SurfaceMesh& mesh) {
    for (const auto& t : mesh.triangles) {
        triangles_.push_back({mesh.vertices_g_m[t[0]], mesh.vertices_g_m[t[1]], mesh.vertices_g_m[t[2]]});
    }
    nodes_.emplace_back();
    build(0, 0, triangles_.size());
}

void DistanceToMesh::build(std::size_t node, std::size_t first, std::size_t last) {
    Box middles;
    for (std::size_t i = first; i < last; ++i) {
        for (const auto& corner : triangles_[i]) nodes_[node].box.extend(corner);
        middles.extend(middle(triangles_[i]));
    }
    if (last - first <= most_in_a_leaf) {
        nodes_[node].first = static_cast<std::uint32_t>(first);
        nodes_[node].count = static_cast<std::uint32_t>(last - first);
        return;
    }
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::size_t half = (first + last) / 2;
    const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(half), at(last), [axis](const Corners& a, const Corners& b) {
        return middle(a)[axis] < middle(b)[axis];
    });
    const std::size_t children = nodes_.size();
    nodes_[node].first = static_cast<std::uint32_t>(children);
    nodes_.resize(children + 2);
    build(children, first, half);
    build(children + 1, half, last);
}

ClosestPoint DistanceToMesh::closest(const Eigen::Vector3f& p_m) const {
    float least = std::numeric_limits<float>::infinity();
    ClosestPoint best;
    const Corners* best_triangle = nullptr;
    std::array<std::uint32_t, 64> waiting{};
    std::size_t count = 1;
    while (count > 0) {
        const Node& node = nodes_[waiting[--count]];
        if (node.box.squaredExteriorDistance(p_m) >= least) continue;
        for (std::size_t i = node.first; i < node.first + node.count; ++i) {
            const Eigen::Vector3f point = closest_on_triangle(p_m, triangles_[i]);
            const float squared = (point - p_m).squaredNorm();
            if (squared >= least) continue;
            least = squared;
            best.point_m = point;
            best_triangle = &triangles_[i];
        }
        if (node.count > 0) continue;
        const float left = nodes_[node.first].box.squaredExteriorDistance(p_m);
        const float right = nodes_[node.first + 1].box.squaredExteriorDistance(p_m);
        waiting[count++] = left < right ? node.first + 1 : node.first;  // the nearer is looked at first
        waiting[count++] = left < right ? node.first : node.first + 1;
    }
    best.distance_m = std::sqrt(least);
    const auto& [a, b, c] = *best_triangle;
    const Eigen::Vector3f turned = (b - a).cross(c - a);
    best.normal = turned.squaredNorm() > 0.0f ? turned.normalized() : turned;
    return best;
}

}  // namespace touchstone
