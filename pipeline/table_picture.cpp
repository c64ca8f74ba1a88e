#include "pipeline/table_picture.hpp"

#include <cmath>

namespace touchstone {

using Eigen::Vector2f;
using Eigen::Vector3f;

bool in_picture(const TablePicture& picture, int x, int y) {
    return x >= 0 && y >= 0 && x < picture.shape.width_px && y < picture.shape.height_px;
}

Vector3f back_project(const Intrinsics& k, int x, int y, float depth_m) {
    return depth_m * Vector3f((static_cast<float>(x) - k.cx_px) / k.fx_px,
                              (static_cast<float>(y) - k.cy_px) / k.fy_px, 1.0f);
}

Vector2f project(const Intrinsics& k, const Vector3f& p) {
    return {p.x() / p.z() * k.fx_px + k.cx_px, p.y() / p.z() * k.fy_px + k.cy_px};
}

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

SurfacePoint foot_point(const TablePicture& picture, const Vector3f& point_c_m) {
    Vector3f foot = point_c_m;
    SurfacePoint surface;
    for (int i = 0; i < 3; ++i) {
        if (!(foot.z() > 0.05f)) return surface;
        const Vector2f pixel = project(picture.intrinsics, foot);
        const Vector2f limit(static_cast<float>(picture.shape.width_px),
                             static_cast<float>(picture.shape.height_px));
        if (!(pixel.minCoeff() >= 0.0f && pixel.x() < limit.x() - 0.5f && pixel.y() < limit.y() - 0.5f))
            return surface;
        const SurfacePoint here = background_at(picture, static_cast<int>(std::lround(pixel.x())),
                                                static_cast<int>(std::lround(pixel.y())));
        if (!here.known) return surface;
        surface = here;
        foot = point_c_m - here.normal_c.dot(point_c_m - here.point_c_m) * here.normal_c;
    }
    surface.point_c_m = foot;
    return surface;
}

}  // namespace touchstone
