#include "ui/surface_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

using Eigen::AlignedBox2f;
using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float assumed_depth_m = 1.f;
constexpr float assumed_view_width_m = 1.088f;
constexpr float nearest_m = 0.2f, farthest_m = 10.f;                // or twice as far as the area
constexpr float edge_mm = 8.f;                                      // between a row and the edge of the area
constexpr float least_row_width = 0.35f, least_rows_height = 0.4f;  // of the view's
constexpr float part_of_table = 0.25f;                              // of these, for one of several areas

Intrinsics assumed_intrinsics(PixelSize view) {
    const float focal_px = static_cast<float>(view.width_px) * assumed_depth_m / assumed_view_width_m;
    Intrinsics k{};
    k.fx_px = k.fy_px = focal_px;
    k.cx_px = 0.5f * static_cast<float>(view.width_px - 1);
    k.cy_px = 0.5f * static_cast<float>(view.height_px - 1);
    return k;
}

}  // namespace

SurfaceGeometry::SurfaceGeometry(const TableFrame& frame, PixelSize view)
    : view_(view),
      is_camera_known_(frame.intrinsics.fx_px > 0.f),
      T_g_c_(frame.T_g_c),
      room_(frame.has_area ? SurfaceRoom(frame.area_px, view_box()) : SurfaceRoom(view_box())) {
    intrinsics_ = is_camera_known_ ? frame.intrinsics : assumed_intrinsics(view);
    if (!frame.has_area) return;
    area_ = frame.area;
    const Vector3f middle = area_->origin_c_m + 0.5f * (area_->axis_u_c_m + area_->axis_v_c_m);
    farthest_m_ = std::max(farthest_m, 2.f * middle.z());
    corners_px_ = frame.area_px;
    std::array<float, 4> y_px{};
    for (std::size_t i = 0; i < 4; ++i) y_px[i] = corners_px_[i].y();
    std::sort(y_px.begin(), y_px.end());
    const auto height = static_cast<float>(view.height_px), width = static_cast<float>(view.width_px);
    top_px_ = std::max(y_px[1], 0.f);
    bottom_px_ = std::min(y_px[2], height - 1.f);
    const float share = frame.is_part ? part_of_table : 1.f;
    if (bottom_px_ - top_px_ < share * least_rows_height * height) return;
    const auto wide = [&](float at_px) {
        const auto span = room_.span_px(at_px);
        return span && span->y() - span->x() >= share * least_row_width * width;
    };
    rows_in_area_ = wide(top_px_ + 1.f) && wide(bottom_px_ - 1.f);
}

float SurfaceGeometry::depth_m(const Vector2f& place_px) const {
    if (!area_) return assumed_depth_m;
    const Vector3f ray = back_project(intrinsics_, place_px.x(), place_px.y(), 1.f);
    const Vector3f normal = area_->axis_u_c_m.cross(area_->axis_v_c_m);
    const float depth = normal.dot(area_->origin_c_m) / normal.dot(ray);
    return depth > nearest_m && depth < farthest_m_ ? depth : assumed_depth_m;
}

float SurfaceGeometry::mm_per_px(const Vector2f& place_px) const {
    return 1000.f * depth_m(place_px) / intrinsics_.fx_px;
}

Vector3f SurfaceGeometry::point_g_m(const Fingertip& tip) const {
    if (is_camera_known_ && tip.surface_c_m.z() > 0.f) return T_g_c_ * tip.surface_c_m;
    return T_g_c_ * back_project(intrinsics_, tip.pixel_px.x(), tip.pixel_px.y(), depth_m(tip.pixel_px));
}

std::optional<Vector2f> SurfaceGeometry::pixel_px(const Vector3f& point_g_m) const {
    const Vector3f c = T_g_c_.inverse(Eigen::Isometry) * point_g_m;
    if (c.z() < nearest_m) return std::nullopt;
    return project(intrinsics_, c);
}

float SurfaceGeometry::length_px(const Vector3f& point_g_m, float length_mm) const {
    const float depth = (T_g_c_.inverse(Eigen::Isometry) * point_g_m).z();
    return 0.001f * length_mm * intrinsics_.fx_px / std::max(depth, nearest_m);
}

AlignedBox2f SurfaceGeometry::view_box() const {
    return {Vector2f(0.f, 0.f),
            Vector2f(static_cast<float>(view_.width_px - 1), static_cast<float>(view_.height_px - 1))};
}

AlignedBox2f SurfaceGeometry::row(float from_px, float to_px) const {
    AlignedBox2f box = view_box();
    const float edge_px = edge_mm / mm_per_px(box.center());
    Vector2f across(box.min().x(), box.max().x());
    if (rows_in_area_)
        for (const float y : {from_px, to_px})
            if (const auto span = room_.span_px(y))
                across = {std::max(across.x(), span->x()), std::min(across.y(), span->y())};
    return {Vector2f(across.x() + edge_px, from_px), Vector2f(across.y() - edge_px, to_px)};
}

AlignedBox2f SurfaceGeometry::top_row(float height_px) const {
    const float edge_px = edge_mm / mm_per_px(view_box().center());
    const float from = (rows_in_area_ ? top_px_ : 0.f) + edge_px;
    return row(from, from + height_px);
}

AlignedBox2f SurfaceGeometry::bottom_row(float height_px) const {
    const float edge_px = edge_mm / mm_per_px(view_box().center());
    const float to = (rows_in_area_ ? bottom_px_ : view_box().max().y()) - edge_px;
    return row(to - height_px, to);
}

Vector2f SurfaceGeometry::along_area(const Vector2f& direction_px) const {
    if (!area_) return direction_px;
    Eigen::Matrix2f axes;
    axes << (corners_px_[1] - corners_px_[0]).normalized(), (corners_px_[3] - corners_px_[0]).normalized();
    if (std::abs(axes.determinant()) < 0.2f) return direction_px;
    return axes.inverse() * direction_px;
}

}  // namespace touchstone
