#pragma once

#include <gtest/gtest.h>
#include <string>

#include "picture_probe.hpp"
#include "platform/display/gl_error.hpp"
#include "platform/display/headless_display.hpp"
#include "ui/layout.hpp"
#include "ui/scene_list.hpp"
#include "ui/table_presenter.hpp"
#include "ui/touch_menu.hpp"

namespace touchstone {

/// A scene on a white table 1.1 m under the camera, its interactive area in the middle, touched by script.
class SceneFixture : public testing::Test {
  protected:
    static constexpr PixelSize display_size{960, 600}, view_size{320, 240};
    static constexpr float table_m = 1.1f;
    static constexpr int tolerance = 3;  // of 255: rounding in filters and blending

    SceneFixture() {
        auto view = std::make_shared<ShadedView>();
        *view = {view_size.width_px, view_size.height_px,
                 std::vector<std::uint8_t>(std::size_t{4} * 320 * 240, 255)};
        frame_.state = "live";
        frame_.frame_rate_hz = 30.f;
        frame_.view = view;
        frame_.intrinsics = {290.f, 290.f, 159.5f, 119.5f, 320, 240, {0, 0}};
        frame_.has_area = true;
        frame_.area = {{-0.55f, -0.4f, table_m}, {1.1f, 0.f, 0.f}, {0.f, 0.8f, 0.f}};
        const Eigen::Vector2f low = pixel_of(frame_.area.origin_c_m);
        const Eigen::Vector2f high =
            pixel_of(frame_.area.origin_c_m + frame_.area.axis_u_c_m + frame_.area.axis_v_c_m);
        frame_.area_px = {low, Eigen::Vector2f(high.x(), low.y()), high, Eigen::Vector2f(low.x(), high.y())};
    }

    void open(const std::string& scene, PresenterConfig config = {}) {
        presenter_.reset();
        presenter_ = std::make_unique<TablePresenter>(*display_, scene, config);
        present();
    }

    Eigen::Vector2f pixel_of(const Eigen::Vector3f& c) const {
        return {290.f * c.x() / c.z() + 159.5f, 290.f * c.y() / c.z() + 119.5f};
    }

    TouchEvent touch(int id, TouchPhase phase, Eigen::Vector2f pixel_px) const {
        TouchEvent event;
        event.tip.id = id;
        event.tip.pixel_px = pixel_px;
        event.tip.surface_c_m = back_project(frame_.intrinsics, pixel_px.x(), pixel_px.y(), table_m);
        event.phase = phase;
        return event;
    }

    Picture present(std::vector<TouchEvent> touches = {}, std::vector<HoverEvent> hovers = {}) {
        ++frame_.index;
        frame_.timestamp_us += 33'333;
        frame_.touches = std::move(touches);
        frame_.hovers = std::move(hovers);
        presenter_->present(frame_, 1.f / 30.f);
        EXPECT_EQ(take_gl_errors(), "");
        return display_->read_pixels();
    }

    void pass(float seconds) {
        for (int i = 0; i < static_cast<int>(30.f * seconds); ++i) present();
    }

    Picture tap(Eigen::Vector2f place_px, float seconds = 0.1f) {
        const int id = ++ids_given_;
        present({touch(id, TouchPhase::down, place_px)});
        for (int i = 0; i < static_cast<int>(30.f * seconds); ++i)
            present({touch(id, TouchPhase::move, place_px)});
        return present({touch(id, TouchPhase::up, place_px)});
    }

    Picture stroke(Eigen::Vector2f a, Eigen::Vector2f b, int steps = 8) {
        const int id = ++ids_given_;
        present({touch(id, TouchPhase::down, a)});
        for (int i = 1; i <= steps; ++i)
            present({touch(id, TouchPhase::move,
                           a + static_cast<float>(i) / static_cast<float>(steps) * (b - a))});
        present({touch(id, TouchPhase::up, b)});
        pass(0.3f);  // the glow of a button fades
        return present();
    }

    style::Color color_at_view(const Picture& picture, Eigen::Vector2f pixel_px) const {
        const Eigen::Vector2f at = make_layout(display_size, view_size).view.to_display(pixel_px);
        return color_at(picture, static_cast<int>(at.x()), static_cast<int>(at.y()));
    }

    /// Where the menu draws a scene's tile, and its handle.
    Eigen::Vector2f menu_tile_px(const std::string& scene) const {
        const Layout layout = make_layout(display_size, view_size);
        const SurfaceGeometry surface(frame_, view_size);
        Canvas canvas;
        canvas.begin({960.f, 600.f}, layout.scale);
        TouchMenu menu(scene_names());
        menu.draw(canvas, layout.view, surface, "");
        const Eigen::Vector2f handle = menu.handle_px().center();
        if (scene.empty()) return handle;
        menu.on_touch(touch(1, TouchPhase::down, handle));
        menu.update(1);
        menu.draw(canvas, layout.view, surface, "");
        return menu.place_px(scene).center();
    }

    std::unique_ptr<Display> display_ = make_headless_display(display_size);
    std::unique_ptr<TablePresenter> presenter_;
    TableFrame frame_;
    int ids_given_ = 0;
};

}  // namespace touchstone
