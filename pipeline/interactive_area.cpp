#include "pipeline/interactive_area.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

namespace touchstone {

namespace {

constexpr int ransac_rounds = 300;
constexpr float min_plane_share = 0.15f;

Plane plane_through(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    Eigen::Vector3f n = (b - a).cross(c - a).normalized();
    if (n.dot(a) > 0.0f) n = -n;
    return {n, n.dot(a), 0.0f};
}

Plane least_squares(const std::vector<Eigen::Vector3f>& points, const Plane& start, float tolerance_m) {
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
    float count = 0.0f;
    const auto on_plane = [&](const Eigen::Vector3f& p) {
        return std::abs(start.normal_c.dot(p) - start.offset_m) < tolerance_m;
    };
    for (const Eigen::Vector3f& p : points) {
        if (!on_plane(p)) continue;
        mean += p;
        count += 1.0f;
    }
    mean /= count;
    for (const Eigen::Vector3f& p : points) {
        if (on_plane(p)) spread += (p - mean) * (p - mean).transpose();
    }
    Eigen::Vector3f n = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(spread).eigenvectors().col(0);
    if (n.dot(mean) > 0.0f) n = -n;
    return {n, n.dot(mean), count / static_cast<float>(points.size())};
}

std::vector<Eigen::Vector3f> surface_points_c_m(const SurfacePrediction& background, const Intrinsics& k,
                                                int step_px) {
    std::vector<Eigen::Vector3f> points;
    const auto depth_m = background.depth_m.map_read();
    for (int y = 0; y < k.height_px; y += step_px) {
        for (int x = 0; x < k.width_px; x += step_px) {
            const float z = depth_m[map_index(background.shape, x, y)];
            if (z <= 0.0f) continue;
            points.push_back(back_project(k, x, y, z));
        }
    }
    return points;
}

struct Rectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< cells, ends excluded
    int cells() const { return (x1 - x0) * (y1 - y0); }
};

/// The largest rectangle of set cells: for each row the heights of the columns above it, each column as the
/// lowest.
Rectangle largest_rectangle(const std::vector<bool>& set, int width, int height) {
    Rectangle best;
    std::vector<int> column(static_cast<std::size_t>(width), 0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            int& tall = column[static_cast<std::size_t>(x)];
            tall = set[static_cast<std::size_t>(y * width + x)] ? tall + 1 : 0;
        }
        for (int x = 0; x < width; ++x) {
            int lowest = column[static_cast<std::size_t>(x)];
            for (int right = x; right < width && lowest > 0; ++right) {
                lowest = std::min(lowest, column[static_cast<std::size_t>(right)]);
                const Rectangle candidate{x, y + 1 - lowest, right + 1, y + 1};
                if (candidate.cells() > best.cells()) best = candidate;
            }
        }
    }
    return best;
}

/// A grid over the plane, axes u and v, with the cells that the scanned surface fills.
struct FilledCells {
    Eigen::Vector3f origin_c_m, u, v;
    float u0_m = 0.f, v0_m = 0.f;
    int width = 0, height = 0;
    std::vector<bool> filled;
};

FilledCells fill_grid(const std::vector<Eigen::Vector3f>& points, const Plane& plane,
                      const InteractiveAreaConfig& config) {
    FilledCells grid;
    const Eigen::Vector3f n = plane.normal_c;
    grid.origin_c_m = n * plane.offset_m;
    grid.u = (Eigen::Vector3f::UnitX() - n * n.x()).normalized();
    grid.v = grid.u.cross(n).normalized();
    if (grid.v.y() < 0.0f) grid.v = -grid.v;
    std::vector<Eigen::Vector2f> on_surface;
    for (const Eigen::Vector3f& p : points) {
        const float height_m = n.dot(p) - plane.offset_m;
        if (height_m < -config.plane_tolerance_m || height_m > config.standing_height_m) continue;
        on_surface.emplace_back(grid.u.dot(p - grid.origin_c_m), grid.v.dot(p - grid.origin_c_m));
    }
    Eigen::Vector2f low = Eigen::Vector2f::Constant(1e9f), high = -low;
    for (const Eigen::Vector2f& p : on_surface) low = low.cwiseMin(p), high = high.cwiseMax(p);
    grid.u0_m = low.x(), grid.v0_m = low.y();
    grid.width = static_cast<int>((high.x() - low.x()) / config.cell_m) + 1;
    grid.height = static_cast<int>((high.y() - low.y()) / config.cell_m) + 1;
    grid.filled.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), false);
    for (const Eigen::Vector2f& p : on_surface) {
        const int x = static_cast<int>((p.x() - low.x()) / config.cell_m),
                  y = static_cast<int>((p.y() - low.y()) / config.cell_m);
        grid.filled[static_cast<std::size_t>(y * grid.width + x)] = true;
    }
    return grid;
}

/// Cells enclosed by filled ones on all four sides are filled too: shadows of things that stand on the
/// surface.
void close_shadows(FilledCells& grid) {
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * grid.width + x); };
    std::vector<bool> left(grid.filled.size()), right(left), up(left), down(left);
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x)
            left[at(x, y)] = grid.filled[at(x, y)] || (x > 0 && left[at(x - 1, y)]);
        for (int x = grid.width - 1; x >= 0; --x) {
            right[at(x, y)] = grid.filled[at(x, y)] || (x + 1 < grid.width && right[at(x + 1, y)]);
        }
    }
    for (int x = 0; x < grid.width; ++x) {
        for (int y = 0; y < grid.height; ++y)
            up[at(x, y)] = grid.filled[at(x, y)] || (y > 0 && up[at(x, y - 1)]);
        for (int y = grid.height - 1; y >= 0; --y) {
            down[at(x, y)] = grid.filled[at(x, y)] || (y + 1 < grid.height && down[at(x, y + 1)]);
        }
    }
    for (std::size_t i = 0; i < grid.filled.size(); ++i)
        grid.filled[i] = left[i] && right[i] && up[i] && down[i];
}

}  // namespace

std::optional<Plane> dominant_plane(const std::vector<Eigen::Vector3f>& points, float tolerance_m) {
    if (points.size() < 100) return std::nullopt;
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> any(0, points.size() - 1);
    Plane best;
    std::size_t most = 0;
    for (int round = 0; round < ransac_rounds; ++round) {
        const Plane plane = plane_through(points[any(random)], points[any(random)], points[any(random)]);
        if (!(plane.normal_c.norm() > 0.5f)) continue;
        const auto on_plane =
            static_cast<std::size_t>(std::ranges::count_if(points, [&](const Eigen::Vector3f& p) {
                return std::abs(plane.normal_c.dot(p) - plane.offset_m) < tolerance_m;
            }));
        if (on_plane > most) most = on_plane, best = plane;
    }
    if (static_cast<float>(most) < min_plane_share * static_cast<float>(points.size())) return std::nullopt;
    return least_squares(points, least_squares(points, best, tolerance_m), tolerance_m);
}

std::optional<InteractiveArea> fit_interactive_area(const SurfacePrediction& background,
                                                    const Intrinsics& intrinsics,
                                                    const InteractiveAreaConfig& config) {
    const auto plane =
        dominant_plane(surface_points_c_m(background, intrinsics, 8), config.plane_tolerance_m);
    if (!plane) return std::nullopt;
    FilledCells grid = fill_grid(surface_points_c_m(background, intrinsics, 2), *plane, config);
    close_shadows(grid);
    const Rectangle cells = largest_rectangle(grid.filled, grid.width, grid.height);
    const float width_m = static_cast<float>(cells.x1 - cells.x0) * config.cell_m - 2.0f * config.margin_m;
    const float height_m = static_cast<float>(cells.y1 - cells.y0) * config.cell_m - 2.0f * config.margin_m;
    if (width_m < config.min_side_m || height_m < config.min_side_m) return std::nullopt;
    const float u_m = grid.u0_m + static_cast<float>(cells.x0) * config.cell_m + config.margin_m;
    const float v_m = grid.v0_m + static_cast<float>(cells.y0) * config.cell_m + config.margin_m;
    return InteractiveArea{grid.origin_c_m + u_m * grid.u + v_m * grid.v, width_m * grid.u,
                           height_m * grid.v};
}

InteractiveArea whole_view_area(const SurfacePrediction& background, const Intrinsics& k) {
    std::vector<Eigen::Vector3f> points = surface_points_c_m(background, k, 8);
    float depth_m = 1.0f;
    if (!points.empty()) {
        const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
        std::ranges::nth_element(points, middle, {}, [](const Eigen::Vector3f& p) { return p.z(); });
        depth_m = middle->z();
    }
    const Eigen::Vector3f corner(-k.cx_px / k.fx_px, -k.cy_px / k.fy_px, 1.0f);
    const float width = static_cast<float>(k.width_px) / k.fx_px,
                height = static_cast<float>(k.height_px) / k.fy_px;
    return {depth_m * corner, Eigen::Vector3f(depth_m * width, 0.0f, 0.0f),
            Eigen::Vector3f(0.0f, depth_m * height, 0.0f)};
}

Eigen::Vector3f point_on(const InteractiveArea& area, const Eigen::Vector2f& uv) {
    return area.origin_c_m + uv.x() * area.axis_u_c_m + uv.y() * area.axis_v_c_m;
}

std::array<Eigen::Vector2f, 4> area_corners_px(const InteractiveArea& area, const Intrinsics& k) {
    std::array<Eigen::Vector2f, 4> corners_px;
    std::ranges::transform(area_corners_uv, corners_px.begin(),
                           [&](const Eigen::Vector2f& uv) { return project(k, point_on(area, uv)); });
    return corners_px;
}

}  // namespace touchstone
