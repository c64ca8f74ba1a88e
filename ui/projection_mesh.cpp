#include "ui/projection_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr int flat_cells = 32;  // each way

std::size_t index_of(const SurfaceGrid& grid, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
}

/// Median distance of neighbours in a row.
float spacing_m(const SurfaceGrid& grid) {
    std::vector<float> distances_m;
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x + 1 < grid.width; ++x) {
            const Vector4f& a = grid.points_g_m[index_of(grid, x, y)];
            const Vector4f& b = grid.points_g_m[index_of(grid, x + 1, y)];
            if (a.w() > 0.f && b.w() > 0.f) distances_m.push_back((a - b).norm());
        }
    if (distances_m.empty()) return 0.f;
    const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
    std::nth_element(distances_m.begin(), middle, distances_m.end());
    return *middle;
}

/// Fills the holes of a grid from the points at both ends of each gap of a row or a column.
class HoleFilling {
  public:
    HoleFilling(const SurfaceGrid& grid, const ProjectionMeshConfig& config, float step_m)
        : grid_(&grid), config_(config), step_m_(step_m), sums_(grid.points_g_m.size(), Vector4f::Zero()) {}

    std::vector<Vector4f> filled() {
        for (int y = 0; y < grid_->height; ++y) line(index_of(*grid_, 0, y), 1, grid_->width);
        for (int x = 0; x < grid_->width; ++x)
            line(static_cast<std::size_t>(x), static_cast<std::size_t>(grid_->width), grid_->height);
        std::vector<Vector4f> points = grid_->points_g_m;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i].w() <= 0.f && sums_[i].w() > 0.f) points[i] = sums_[i] / sums_[i].w();
        return points;
    }

  private:
    void line(std::size_t first, std::size_t stride, int count) {
        int last_known = -1;
        for (int i = 0; i < count; ++i) {
            if (grid_->points_g_m[first + static_cast<std::size_t>(i) * stride].w() <= 0.f) continue;
            if (last_known >= 0 && i - last_known > 1 && i - last_known - 1 <= config_.most_gap)
                bridge(first + static_cast<std::size_t>(last_known) * stride, stride, i - last_known);
            last_known = i;
        }
    }

    /// The narrower gap, of the row's and the column's, counts for more.
    void bridge(std::size_t from, std::size_t stride, int steps) {
        const Vector4f& a = grid_->points_g_m[from];
        const Vector4f& b = grid_->points_g_m[from + static_cast<std::size_t>(steps) * stride];
        const auto length = static_cast<float>(steps);
        if ((a - b).norm() > config_.jump_m + 2.f * length * step_m_) return;
        for (int i = 1; i < steps; ++i)
            sums_[from + static_cast<std::size_t>(i) * stride] +=
                (a + static_cast<float>(i) / length * (b - a)) / length;
    }

    const SurfaceGrid* grid_;
    ProjectionMeshConfig config_;
    float step_m_;
    std::vector<Vector4f> sums_;  // weighted by w
};

}  // namespace

ProjectionMesh make_projection_mesh(const SurfaceGrid& grid, const ProjectionMeshConfig& config) {
    const float step_m = spacing_m(grid);
    const std::vector<Vector4f> points = HoleFilling(grid, config, step_m).filled();
    const float longest_m = config.jump_m + 2.f * step_m;
    ProjectionMesh mesh;
    mesh.corners_g_m.reserve(points.size());
    for (const Vector4f& point : points) mesh.corners_g_m.emplace_back(point.head<3>());
    const auto joined = [&](std::size_t a, std::size_t b) {
        return points[a].w() > 0.f && points[b].w() > 0.f && (points[a] - points[b]).norm() <= longest_m;
    };
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        if (joined(a, b) && joined(b, c) && joined(c, a))
            mesh.triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                      static_cast<std::uint32_t>(c)});
    };
    for (int y = 0; y + 1 < grid.height; ++y)
        for (int x = 0; x + 1 < grid.width; ++x) {
            const std::size_t a = index_of(grid, x, y), b = index_of(grid, x + 1, y),
                              c = index_of(grid, x, y + 1), d = index_of(grid, x + 1, y + 1);
            add(a, b, c);
            add(c, b, d);
        }
    return mesh;
}

ProjectionMesh make_flat_mesh(const InteractiveArea& area_g) {
    SurfaceGrid grid;
    grid.width = grid.height = flat_cells + 1;
    for (int y = 0; y <= flat_cells; ++y)
        for (int x = 0; x <= flat_cells; ++x) {
            const Vector3f p = area_g.origin_c_m + static_cast<float>(x) / flat_cells * area_g.axis_u_c_m +
                               static_cast<float>(y) / flat_cells * area_g.axis_v_c_m;
            grid.points_g_m.emplace_back(p.x(), p.y(), p.z(), 1.f);
        }
    ProjectionMeshConfig joined;
    joined.jump_m = INFINITY;
    return make_projection_mesh(grid, joined);
}

}  // namespace touchstone
