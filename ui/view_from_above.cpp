#include "ui/view_from_above.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float distance_m = 50.f;  // what is 10 cm high and 50 cm off the middle is seen 1 mm too far out
constexpr float same_place_m = 1e-3f;
constexpr int least_px = 16;

/// Even: some layers have half as many pixels.
int picture_px(float length_m, float px_per_m) {
    return std::max(least_px, 2 * static_cast<int>(std::lround(0.5f * length_m * px_per_m)));
}

std::array<Vector3f, 4> corners(const InteractiveArea& area) {
    const Vector3f &o = area.origin_c_m, &u = area.axis_u_c_m, &v = area.axis_v_c_m;
    return {o, o + u, o + u + v, o + v};
}

std::shared_ptr<const ShadedView> black_picture(PixelSize size) {
    auto view = std::make_shared<ShadedView>();
    *view = {size.width_px, size.height_px, {}};
    view->rgba.assign(4 * static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px),
                      0);
    for (std::size_t alpha = 3; alpha < view->rgba.size(); alpha += 4) view->rgba[alpha] = 255;
    return view;
}

/// What the camera sees at a place of its picture: on the surface, as far as that is known, else on the plane
/// of the area.
Vector3f seen_point_c_m(const TableFrame& frame, const Vector2f& pixel_px) {
    if (frame.surface) {
        const SurfaceGrid& grid = *frame.surface;
        const Vector2f at = pixel_px / static_cast<float>(grid.step_px);
        const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
        if (x >= 0 && y >= 0 && x + 1 < grid.width && y + 1 < grid.height) {
            const auto point = [&](int column, int row) {
                return grid.points_g_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                                       static_cast<std::size_t>(column)];
            };
            const float right = at.x() - static_cast<float>(x), down = at.y() - static_cast<float>(y);
            const Eigen::Vector4f mean_g =
                (1.f - down) * ((1.f - right) * point(x, y) + right * point(x + 1, y)) +
                down * ((1.f - right) * point(x, y + 1) + right * point(x + 1, y + 1));
            if (mean_g.w() > 0.999f) return frame.T_g_c.inverse(Eigen::Isometry) * mean_g.head<3>();
        }
    }
    const Vector3f ray = back_project(frame.intrinsics, pixel_px.x(), pixel_px.y(), 1.f);
    const Vector3f normal = frame.area.axis_u_c_m.cross(frame.area.axis_v_c_m);
    return normal.dot(frame.area.origin_c_m) / normal.dot(ray) * ray;
}

/// Takes what a camera frame tells into the view.
class Mover {
  public:
    Mover(const TableFrame& told, const ViewFromAbove& view)
        : told_(&told), view_(&view), T_v_c_(view.T_g_v.inverse(Eigen::Isometry) * told.T_g_c) {}

    const RigidTransform& T_v_c() const { return T_v_c_; }

    void move(Fingertip& tip) const {
        if (tip.surface_c_m.z() <= 0.f) tip.surface_c_m = seen_point_c_m(*told_, tip.pixel_px);
        tip.surface_c_m = T_v_c_ * tip.surface_c_m;
        tip.pixel_px = project(view_->intrinsics, tip.surface_c_m);
        tip.normal_c = T_v_c_.linear() * tip.normal_c;
        tip.axis_c = T_v_c_.linear() * tip.axis_c;
    }

    void move(ShownArea& area) const {
        area.area = transformed(T_v_c_, area.area);
        const auto around = corners(area.area);
        for (std::size_t i = 0; i < around.size(); ++i)
            area.area_px[i] = project(view_->intrinsics, around[i]);
        for (std::size_t i = 0; i < area.corners_c_m.size(); ++i) {
            area.corners_c_m[i] = T_v_c_ * area.corners_c_m[i];
            area.corners_px[i] = project(view_->intrinsics, area.corners_c_m[i]);
        }
    }

    void move(CrossGuide& cross) const {
        cross.pixel_px = project(view_->intrinsics, T_v_c_ * seen_point_c_m(*told_, cross.pixel_px));
    }

    std::shared_ptr<const ParticleView> moved(const ParticleView& particles) const {
        auto moved = std::make_shared<ParticleView>();
        moved->intrinsics = view_->intrinsics;
        moved->radius_m = particles.radius_m;
        moved->spheres = particles.spheres;
        for (ParticleSphere& sphere : moved->spheres) {
            sphere.centre_c_m = T_v_c_ * sphere.centre_c_m;
            sphere.shadow_c_m = T_v_c_ * sphere.shadow_c_m;
        }
        std::stable_sort(moved->spheres.begin(), moved->spheres.end(),
                         [](const auto& a, const auto& b) { return a.centre_c_m.z() > b.centre_c_m.z(); });
        return moved;
    }

  private:
    const TableFrame* told_;
    const ViewFromAbove* view_;
    RigidTransform T_v_c_;
};

void forget_places(TableFrame& frame) {
    frame.has_area = false;
    frame.intrinsics = {};
    frame.T_g_c = RigidTransform::Identity();
    frame.areas.clear();
    frame.touches.clear();
    frame.hovers.clear();
    frame.cross.reset();
    frame.particles = nullptr;
}

}  // namespace

ViewFromAbove make_view_from_above(const InteractiveArea& area, const RigidTransform& T_g_c,
                                   const ViewFromAboveConfig& config) {
    const float width_m = area.axis_u_c_m.norm(), height_m = area.axis_v_c_m.norm();
    const float px_per_m =
        std::min(1000.f * config.px_per_mm, static_cast<float>(config.most_px) / std::max(width_m, height_m));
    ViewFromAbove view;
    Intrinsics& k = view.intrinsics;
    k.width_px = picture_px(width_m, px_per_m);
    k.height_px = picture_px(height_m, px_per_m);
    k.fx_px = k.fy_px = px_per_m * distance_m;
    k.cx_px = 0.5f * static_cast<float>(k.width_px - 1);
    k.cy_px = 0.5f * static_cast<float>(k.height_px - 1);

    const Vector3f normal_g = T_g_c.linear() * facing_normal(area);
    const Vector3f right_g = T_g_c.linear() * area.axis_u_c_m.normalized();
    view.T_g_v.linear() << right_g, right_g.cross(normal_g), -normal_g;
    view.area_g = transformed(T_g_c, area);
    view.T_g_v.translation() = view.area_g.origin_c_m +
                               0.5f * (view.area_g.axis_u_c_m + view.area_g.axis_v_c_m) +
                               distance_m * normal_g;
    view.black = black_picture(view.size_px());
    return view;
}

bool is_view_of(const ViewFromAbove& view, const TableFrame& frame) {
    if (!frame.has_area || !view.black) return false;
    const auto ours = corners(view.area_g), theirs = corners(transformed(frame.T_g_c, frame.area));
    return std::equal(ours.begin(), ours.end(), theirs.begin(),
                      [](const Vector3f& a, const Vector3f& b) { return (a - b).norm() < same_place_m; });
}

TableFrame seen_from_above(const TableFrame& told, const ViewFromAbove& view) {
    TableFrame frame = told;
    frame.view = view.black;
    frame.rendered = nullptr;
    if (!told.has_area || told.intrinsics.fx_px <= 0.f || !view.black) {
        forget_places(frame);
        return frame;
    }
    const Mover mover(told, view);
    frame.intrinsics = view.intrinsics;
    frame.T_g_c = view.T_g_v;
    frame.area = transformed(mover.T_v_c(), told.area);
    const auto corners_v_m = corners(frame.area);
    for (std::size_t i = 0; i < corners_v_m.size(); ++i)
        frame.area_px[i] = project(view.intrinsics, corners_v_m[i]);
    for (ShownArea& area : frame.areas) mover.move(area);
    for (TouchEvent& touch : frame.touches) mover.move(touch.tip);
    for (HoverEvent& hover : frame.hovers) mover.move(hover.tip);
    if (frame.cross) mover.move(*frame.cross);
    if (told.particles) frame.particles = mover.moved(*told.particles);
    return frame;
}

}  // namespace touchstone
