#include "platform/openni2_drivers/simulator/rasteriser.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "platform/openni2_drivers/simulator/static_layer.hpp"

namespace touchstone::sim {
namespace {

using Point = Eigen::Vector3d;

constexpr double near_m = 0.05;

/// a u + b v + c over the picture.
struct Linear {
    double a, b, c;
};

struct Box {
    int left, top, right, bottom;  ///< right and bottom are outside
};

/// Value of n . ray as a function of the pixel.
Linear over_pixels(const Point& n, const Intrinsics& k) {
    const double a = n.x() / static_cast<double>(k.fx_px);
    const double b = n.y() / static_cast<double>(k.fy_px);
    return {a, b, n.z() - a * static_cast<double>(k.cx_px) - b * static_cast<double>(k.cy_px)};
}

/// Positive for rays to the left of the edge from i to j, negative to the right. Both triangles at an edge
/// compute the same numbers, so that no pixel falls between them.
Linear edge(const std::vector<Point>& points, std::uint32_t i, std::uint32_t j, const Intrinsics& k) {
    const Linear line = over_pixels(points[std::min(i, j)].cross(points[std::max(i, j)]), k);
    return i < j ? line : Linear{-line.a, -line.b, -line.c};
}

/// Pixels that the part of the triangle beyond the near plane may cover.
Box bounds(const std::array<Point, 3>& corners, const Intrinsics& k) {
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
    const auto take = [&](const Point& p) {
        const double u = static_cast<double>(k.fx_px) * p.x() / p.z() + static_cast<double>(k.cx_px);
        const double v = static_cast<double>(k.fy_px) * p.y() / p.z() + static_cast<double>(k.cy_px);
        left = std::min(left, u);
        right = std::max(right, u);
        top = std::min(top, v);
        bottom = std::max(bottom, v);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const Point& p = corners[i];
        const Point& q = corners[(i + 1) % 3];
        if (p.z() >= near_m) take(p);
        if ((p.z() < near_m) != (q.z() < near_m)) take(p + (near_m - p.z()) / (q.z() - p.z()) * (q - p));
    }
    constexpr double slack_px = 1e-6;
    const auto pixel = [](double value, int size) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    return {pixel(std::ceil(left - slack_px), k.width_px), pixel(std::ceil(top - slack_px), k.height_px),
            pixel(std::floor(right + slack_px) + 1.0, k.width_px),
            pixel(std::floor(bottom + slack_px) + 1.0, k.height_px)};
}

/// Narrows [begin, end) to where the line may be positive or zero, with a pixel to spare.
void narrow(const Linear& line, double at_row, int& begin, int& end) {
    if (line.a == 0.0) return;
    const double crossing = std::clamp(-at_row / line.a, -2.0, 1e6);
    if (line.a > 0.0)
        begin = std::max(begin, static_cast<int>(std::floor(crossing)));
    else
        end = std::min(end, static_cast<int>(std::ceil(crossing)) + 1);
}

struct Sides {
    std::array<Linear, 3> edges;  ///< all positive or zero inside
    Linear inverse_z;
};

/// Draws one triangle; raster.depth_m holds 1/z meanwhile.
void fill(const Sides& sides, const Box& box, std::int32_t number, int width_px, Raster& raster) {
    const auto& [e0, e1, e2] = sides.edges;
    for (int v = box.top; v < box.bottom; ++v) {
        const auto at_row = [v](const Linear& line) { return line.b * v + line.c; };
        const double row0 = at_row(e0), row1 = at_row(e1), row2 = at_row(e2), row_z = at_row(sides.inverse_z);
        int begin = box.left;
        int end = box.right;
        narrow(e0, row0, begin, end);
        narrow(e1, row1, begin, end);
        narrow(e2, row2, begin, end);
        const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px);
        float* depth = raster.depth_m.data() + row;
        std::int32_t* triangle = raster.triangle.data() + row;
        for (int u = begin; u < end; ++u) {
            const double inverse_z = sides.inverse_z.a * u + row_z;
            const bool inside = e0.a * u + row0 >= 0.0 && e1.a * u + row1 >= 0.0 && e2.a * u + row2 >= 0.0;
            if (!inside || inverse_z > 1.0 / near_m || static_cast<float>(inverse_z) <= depth[u]) continue;
            depth[u] = static_cast<float>(inverse_z);
            triangle[u] = number;
        }
    }
}

void draw(const std::vector<Point>& points, const TriangleMesh& mesh, std::size_t number, const Intrinsics& k,
          Raster& raster) {
    const auto& [i, j, l] = mesh.triangles[number];
    const std::array<Point, 3> corners{points[i], points[j], points[l]};
    const Box box = bounds(corners, k);
    if (box.left >= box.right || box.top >= box.bottom) return;
    const Point normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double distance = normal.dot(corners[0]);
    if (distance == 0.0) return;  // seen exactly from its edge, or without area
    Sides sides{{edge(points, i, j, k), edge(points, j, l, k), edge(points, l, i, k)},
                over_pixels(normal / distance, k)};
    if (distance < 0.0)
        for (Linear& side : sides.edges) side = {-side.a, -side.b, -side.c};
    fill(sides, box, static_cast<std::int32_t>(number), k.width_px, raster);
}

/// Tone of the paint, around 1: flat faces are not of one colour.
float pattern(const Vec3& p_s) {
    return 0.95F +
           0.06F * std::sin(23.0F * p_s.x() + 11.0F * p_s.z()) * std::sin(19.0F * p_s.y() - 17.0F * p_s.z()) +
           0.04F * std::sin(61.0F * (p_s.x() + p_s.y()) + 47.0F * p_s.z());
}

}  // namespace

void rasterise(const TriangleMesh& mesh, const Eigen::Isometry3d& T_c_s, const Intrinsics& intrinsics,
               Raster& raster) {
    const auto pixels =
        static_cast<std::size_t>(intrinsics.width_px) * static_cast<std::size_t>(intrinsics.height_px);
    raster.depth_m.assign(pixels, 0.0F);
    raster.triangle.assign(pixels, Raster::no_triangle);
    std::vector<Point> points;
    points.reserve(mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) points.push_back(T_c_s * vertex.cast<double>());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) draw(points, mesh, i, intrinsics, raster);
    for (float& depth : raster.depth_m) depth = depth > 0.0F ? 1.0F / depth : Raster::nothing_m;
}

void shade_raster(const Raster& raster, const TriangleMesh& mesh, const Eigen::Isometry3d& T_s_c,
                  const Eigen::Matrix3d& R_w_s, const Intrinsics& intrinsics,
                  std::vector<std::uint8_t>& color_rgb) {
    const Eigen::Isometry3f pose = T_s_c.cast<float>();
    const Eigen::Matrix3f to_room = R_w_s.cast<float>();
    std::vector<Vec3> normals(mesh.triangles.size());
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = triangle_normal(mesh, i);
    color_rgb.resize(3 * raster.depth_m.size());
    for (std::size_t i = 0; i < raster.depth_m.size(); ++i) {
        if (raster.triangle[i] == Raster::no_triangle) continue;
        const auto number = static_cast<std::size_t>(raster.triangle[i]);
        const auto u = static_cast<float>(static_cast<int>(i) % intrinsics.width_px);
        const auto v = static_cast<float>(static_cast<int>(i) / intrinsics.width_px);
        const Vec3 ray_c((u - intrinsics.cx_px) / intrinsics.fx_px, (v - intrinsics.cy_px) / intrinsics.fy_px,
                         1.0F);
        const Vec3 p_s = pose * (raster.depth_m[i] * ray_c).eval();
        const bool from_behind = normals[number].dot(p_s - pose.translation()) > 0.0F;
        const Vec3 normal_w = to_room * (from_behind ? -normals[number] : normals[number]);
        const Vec3 light = pattern(p_s) * shade(mesh.albedo[number], normal_w);
        for (int c = 0; c < 3; ++c) color_rgb[3 * i + static_cast<std::size_t>(c)] = to_byte(light[c]);
    }
}

}  // namespace touchstone::sim
