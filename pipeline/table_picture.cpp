#include "pipeline/table_picture.hpp"

#include <cmath>

namespace touchstone {

using Eigen::Vector2f;
using Eigen::Vector3f;

SurfacePoint background_at(const TablePicture& picture, int x, int y) {
    const std::size_t at = index_of(picture, x, y), plane = map_pixels(picture.shape);
    SurfacePoint surface;
    surface.point_c_m = back_project(picture.intrinsics, x, y, picture.background_m[at]);
    surface.normal_c = {picture.normals_c[at], picture.normals_c[plane + at],
                        picture.normals_c[2 * plane + at]};
    surface.known = picture.background_m[at] > 0.0f && surface.normal_c.squaredNorm() > 0.5f;
    return surface;
}

float sigma_z_m(const SensorNoise& noise, float depth_m) {
    const float from_offset = depth_m - noise.offset_m;
    return noise.constant_m + noise.quadratic * from_offset * from_offset;
}

namespace {

struct Nearest {
    int x = -1, y = -1;
    float distance_m = UNKNOWN_HEIGHT_M;
};

/// The nearest background point of every `stride`-th pixel of a square around (x, y).
Nearest nearest_in_square(const TablePicture& picture, const Vector3f& point_c_m, int x, int y, int half_px,
                          int stride) {
    Nearest nearest;
    for (int j = -half_px; j <= half_px; j += stride) {
        for (int i = -half_px; i <= half_px; i += stride) {
            if (!in_picture(picture, x + i, y + j)) continue;
            const float depth_m = picture.background_m[index_of(picture, x + i, y + j)];
            if (depth_m <= 0.0f) continue;
            const float distance_m =
                (back_project(picture.intrinsics, x + i, y + j, depth_m) - point_c_m).norm();
            if (distance_m < nearest.distance_m) nearest = {x + i, y + j, distance_m};
        }
    }
    return nearest;
}

/// The foot on tangent planes, each at the pixel of the one before: right where the surface is smooth.
SurfacePoint foot_on_planes(const TablePicture& picture, const Vector3f& point_c_m) {
    Vector3f foot = point_c_m;
    SurfacePoint surface;
    for (int i = 0; i < 3; ++i) {
        if (!(foot.z() > 0.05f)) return {};
        const Vector2f pixel = project(picture.intrinsics, foot);
        if (!(std::abs(pixel.x()) < 1e5f && std::abs(pixel.y()) < 1e5f)) return {};
        const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
        if (!in_picture(picture, x, y)) return {};
        surface = background_at(picture, x, y);
        if (!surface.known) return {};
        foot = point_c_m - surface.normal_c.dot(point_c_m - surface.point_c_m) * surface.normal_c;
    }
    surface.point_c_m = foot;
    return surface;
}

}  // namespace

SurfacePoint foot_point(const TablePicture& picture, const Vector3f& point_c_m) {
    constexpr int hole_px = 12;  // of the prediction, along edges
    constexpr int samples = 8;   // to each side, in the coarse search
    if (!(point_c_m.z() > 0.05f)) return {};
    const Vector2f pixel = project(picture.intrinsics, point_c_m);
    const Vector2f limit(static_cast<float>(picture.shape.width_px),
                         static_cast<float>(picture.shape.height_px));
    if (!(pixel.minCoeff() >= 0.0f && pixel.x() < limit.x() - 0.5f && pixel.y() < limit.y() - 0.5f))
        return {};
    const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
    Nearest nearest = nearest_in_square(picture, point_c_m, x, y, 2, 1);
    if (nearest.x < 0) nearest = nearest_in_square(picture, point_c_m, x, y, hole_px, 2);
    if (nearest.x < 0) return {};
    // Nothing farther away than the first point found can be nearer.
    int reach_px = static_cast<int>(nearest.distance_m * picture.intrinsics.fx_px / point_c_m.z()) + 1;
    while (reach_px > 0) {
        const int stride = (reach_px + samples - 1) / samples;
        nearest = nearest_in_square(picture, point_c_m, nearest.x, nearest.y, stride * samples, stride);
        reach_px = stride > 1 ? stride : 0;
    }
    SurfacePoint smooth = foot_on_planes(picture, point_c_m);
    const float height_m = smooth.normal_c.dot(point_c_m - smooth.point_c_m);
    if (smooth.known && std::abs(height_m - nearest.distance_m) < 0.15f * nearest.distance_m + 0.001f)
        return smooth;
    return background_at(picture, nearest.x, nearest.y);
}

}  // namespace touchstone
