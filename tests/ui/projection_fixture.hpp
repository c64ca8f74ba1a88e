#pragma once

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <optional>

#include "picture_probe.hpp"
#include "platform/display/gl_error.hpp"
#include "platform/display/headless_display.hpp"
#include "ui/canvas_renderer.hpp"
#include "ui/projected_display.hpp"

namespace touchstone {

/// A table of analytic shape under a depth camera and a projector that stands aside. Frame t: on the middle
/// of the table, x and y along it, z down into it.
class ProjectionFixture : public testing::Test {
  protected:
    using Height = std::function<float(float x_m, float y_m)>;

    static constexpr PixelSize projector_size{1280, 800};
    static constexpr float width_m = 0.6f, height_m = 0.4f;  // of the area

    static float flat(float, float) { return 0.f; }
    /// 6 cm high, 20 cm wide, aslant over the table.
    static float ridge(float x_m, float y_m) {
        const float across = (0.8f * x_m + 0.6f * y_m) / 0.1f;
        return std::abs(across) < 1.f ? 0.06f * std::pow(std::cos(1.5708f * across), 2.f) : 0.f;
    }
    /// 5 cm deep, 36 cm wide.
    static float bowl(float x_m, float y_m) {
        const float r2 = (x_m * x_m + y_m * y_m) / (0.18f * 0.18f);
        return r2 < 1.f ? -0.05f * (1.f - r2) * (1.f - r2) : 0.f;
    }

    explicit ProjectionFixture(PixelSize display = projector_size)
        : projector_(make_headless_display(display)) {
        T_g_t_.linear() =
            Eigen::AngleAxisf(0.5f, Eigen::Vector3f(0.2f, 0.3f, 0.9f).normalized()).toRotationMatrix();
        T_g_t_.translation() = Eigen::Vector3f(0.3f, -0.2f, 1.4f);
        frame_.state = "live";
        frame_.frame_rate_hz = 30.f;
        frame_.intrinsics = {570.f, 570.f, 319.5f, 239.5f, 640, 480, {0, 0}};
        frame_.T_g_c = T_g_t_ * looking_at_table({0.05f, 0.25f, -1.05f});
        frame_.area =
            transformed(frame_.T_g_c.inverse() * T_g_t_,
                        {{-0.5f * width_m, -0.5f * height_m, 0.f}, {width_m, 0, 0}, {0, height_m, 0}});
        frame_.has_area = true;
        see([](int, int) { return false; });

        model_.width_px = projector_size.width_px;
        model_.height_px = projector_size.height_px;
        model_.focal_px = {1500.f, 1510.f};
        model_.center_px = {650.f, 420.f};
        model_.distortion = {-0.08f, 0.02f, 0.002f, -0.001f};
        model_.T_p_g = (T_g_t_ * looking_at_table({0.5f, -0.35f, -1.2f})).inverse();
    }

    /// The pose T_t_x of what looks at the table's middle from there, its x along the table.
    static RigidTransform looking_at_table(const Eigen::Vector3f& from_t_m) {
        const Eigen::Vector3f z = -from_t_m.normalized();
        const Eigen::Vector3f y = z.cross(Eigen::Vector3f::UnitX()).normalized();
        RigidTransform T_t_x = RigidTransform::Identity();
        T_t_x.linear() << y.cross(z), y, z;
        T_t_x.translation() = from_t_m;
        return T_t_x;
    }

    /// Where a ray of frame t first meets the surface.
    static std::optional<Eigen::Vector3f> hit_t_m(const Height& height, const Eigen::Vector3f& from,
                                                  const Eigen::Vector3f& ray) {
        const auto depth = [&](float s) {
            const Eigen::Vector3f p = from + s * ray;
            return p.z() + height(p.x(), p.y());
        };
        float above = (-0.1f - from.z()) / ray.z(), below = above;
        const float step = 0.006f / ray.z(), last = (0.1f - from.z()) / ray.z();
        while (depth(below) < 0.f) {
            above = below;
            if ((below += step) > last) return std::nullopt;
        }
        for (int i = 0; i < 14; ++i) {
            const float middle = 0.5f * (above + below);
            (depth(middle) < 0.f ? above : below) = middle;
        }
        return Eigen::Vector3f(from + below * ray);
    }

    /// What the depth camera sees of it, each `step_px` pixels.
    std::shared_ptr<SurfaceGrid> grid_of(const Height& height, int step_px = 2) const {
        auto grid = std::make_shared<SurfaceGrid>();
        *grid = {1, 640 / step_px, 480 / step_px, step_px, {}};
        const RigidTransform T_t_c = T_g_t_.inverse() * frame_.T_g_c;
        for (int y = 0; y < grid->height; ++y)
            for (int x = 0; x < grid->width; ++x) {
                const Eigen::Vector3f ray =
                    T_t_c.linear() * back_project(frame_.intrinsics, step_px * x, step_px * y, 1.f);
                const auto hit = hit_t_m(height, T_t_c.translation(), ray);
                const Eigen::Vector3f p = T_g_t_ * hit.value_or(Eigen::Vector3f::Zero());
                grid->points_g_m.push_back(hit ? Eigen::Vector4f(p.x(), p.y(), p.z(), 1.f)
                                               : Eigen::Vector4f(0.f, 0.f, 0.f, 0.f));
            }
        return grid;
    }

    /// The homography of the same projector for the area's plane, its lens taken away.
    ProjectorModel homography() {
        model_.distortion = {0, 0, 0, 0};
        ProjectorModel plane = model_;
        plane.kind = ProjectorModelKind::homography;
        plane.plane_g = transformed(frame_.T_g_c, frame_.area);
        Eigen::Matrix3f K = Eigen::Matrix3f::Identity();
        K.diagonal() << model_.focal_px, 1.f;
        K.col(2).head<2>() = model_.center_px;
        Eigen::Matrix3f axes;
        axes << model_.T_p_g.linear() * plane.plane_g.axis_u_c_m,
            model_.T_p_g.linear() * plane.plane_g.axis_v_c_m, model_.T_p_g * plane.plane_g.origin_c_m;
        plane.H_px_uv = -2.5f * K * axes;  // whatever its factor
        return plane;
    }

    /// The live view of the depth camera, foreground where the predicate says so.
    void see(const std::function<bool(int, int)>& is_foreground) {
        auto view = std::make_shared<ShadedView>();
        *view = {640, 480, {}};
        for (int y = 0; y < 480; ++y)
            for (int x = 0; x < 640; ++x)
                view->rgba.insert(view->rgba.end(),
                                  {90, 90, 90, static_cast<std::uint8_t>(is_foreground(x, y) ? 0 : 255)});
        frame_.view = view;
    }

    /// Draws on the display in view pixels, and gives what the projector throws.
    template <class Draw>
    Picture project_drawing(Draw draw) {
        display_.begin_frame();
        glClearColor(0.f, 0.f, 0.f, 1.f);
        glClear(GL_COLOR_BUFFER_BIT);
        const PixelSize size = display_.size_px();
        canvas_.begin({static_cast<float>(size.width_px), static_cast<float>(size.height_px)}, 1.f);
        draw(canvas_);
        renderer_.draw(canvas_);
        display_.present();
        EXPECT_EQ(take_gl_errors(), "");
        return display_.read_pixels();
    }

    /// Calls visit(x_px, y_px, place_mm) for every third pixel across and down of the projector (of `shown`,
    /// which may be of another size than the model) that lights the surface: where, as seen from straight
    /// above, from the area's first corner on. By a way of its own: a ray through the lens, sought by trial,
    /// to the analytic surface.
    template <class Visit>
    void for_each_lit_place(const Height& height, const Picture& shown, Visit visit) const {
        const RigidTransform T_t_p = T_g_t_.inverse() * model_.T_p_g.inverse();
        for (int y = 0; y < shown.height_px; y += 3)
            for (int x = 0; x < shown.width_px; x += 3) {
                const Eigen::Vector2f pixel_px = model_place(shown, x, y);
                const auto hit = hit_t_m(height, T_t_p.translation(), T_t_p.linear() * ray_p(pixel_px));
                if (hit) visit(x, y, place_mm(*hit));
            }
    }

    Eigen::Vector2f model_place(const Picture& shown, int x, int y) const {
        return {(static_cast<float>(x) + 0.5f) * static_cast<float>(model_.width_px) /
                        static_cast<float>(shown.width_px) -
                    0.5f,
                (static_cast<float>(y) + 0.5f) * static_cast<float>(model_.height_px) /
                        static_cast<float>(shown.height_px) -
                    0.5f};
    }

    Eigen::Vector3f ray_p(const Eigen::Vector2f& pixel_px) const {
        Eigen::Vector2f at = (pixel_px - model_.center_px).cwiseQuotient(model_.focal_px);
        ProjectorModel own = model_;
        own.T_p_g = RigidTransform::Identity();
        for (int i = 0; i < 4; ++i)
            at += (pixel_px - *project(own, Eigen::Vector3f(at.x(), at.y(), 1.f)))
                      .cwiseQuotient(model_.focal_px);
        return {at.x(), at.y(), 1.f};
    }

    static Eigen::Vector2f place_mm(const Eigen::Vector3f& point_t_m) {
        return 1000.f * (point_t_m.head<2>() + 0.5f * Eigen::Vector2f(width_m, height_m));
    }

    static bool is_lit(const Picture& picture, int x, int y) { return color_at(picture, x, y).g > 127; }

    std::unique_ptr<Display> projector_;
    ProjectedDisplay display_{*projector_};
    Canvas canvas_;
    CanvasRenderer renderer_;
    RigidTransform T_g_t_ = RigidTransform::Identity();
    TableFrame frame_;
    ProjectorModel model_;
};

}  // namespace touchstone
