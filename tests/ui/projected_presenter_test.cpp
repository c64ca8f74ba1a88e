#include <cstdlib>

#include "platform/image/png_file.hpp"
#include "platform/system/error.hpp"
#include "projection_fixture.hpp"
#include "tests/support/lit_point.hpp"
#include "ui/layout.hpp"
#include "ui/scene_list.hpp"
#include "ui/table_presenter.hpp"
#include "ui/touch_menu.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// The whole way: touches in the depth camera's frame, a scene, the projector's light on a ridge.
class ProjectedPresenterTest : public ProjectionFixture {
  protected:
    static constexpr PixelSize display_size{640, 400};  // half the model's

    ProjectedPresenterTest() : ProjectionFixture(display_size) {
        config_.projected = true;
        display_.set_mapping(model_, view_, grid_of(ridge).get());
        open("paint");
    }

    void open(const std::string& scene) {
        presenter_.reset();
        presenter_ = std::make_unique<TablePresenter>(display_, scene, config_);
        show();
    }

    static Vector3f on_ridge_t_m(const Vector2f& at_mm) {
        const Vector2f t = 0.001f * at_mm - 0.5f * Vector2f(width_m, height_m);
        return {t.x(), t.y(), -ridge(t.x(), t.y())};
    }

    /// A finger on the surface, so far from the area's first corner.
    TouchEvent touch(int id, TouchPhase phase, const Vector2f& at_mm) const {
        TouchEvent event;
        event.phase = phase;
        event.tip.id = id;
        event.tip.surface_c_m = frame_.T_g_c.inverse() * (T_g_t_ * on_ridge_t_m(at_mm));
        event.tip.pixel_px = touchstone::project(frame_.intrinsics, event.tip.surface_c_m);
        return event;
    }

    void show(std::vector<TouchEvent> touches = {}) {
        ++frame_.index;
        frame_.timestamp_us += 33'333;
        frame_.touches = std::move(touches);
        display_.see_hands(frame_);
        presenter_->present(seen_from_above(frame_, view_), 1.f / 30.f);
        EXPECT_EQ(take_gl_errors(), "");
    }

    Picture present() {
        show();
        return display_.read_pixels();
    }

    Picture stroke(int id, const Vector2f& a_mm, const Vector2f& b_mm) {
        show({touch(id, TouchPhase::down, a_mm)});
        for (int i = 1; i <= 10; ++i)
            show({touch(id, TouchPhase::move, a_mm + 0.1f * static_cast<float>(i) * (b_mm - a_mm))});
        show({touch(id, TouchPhase::up, b_mm)});
        return present();
    }

    Picture tap(const Vector2f& at_mm) {
        show({touch(99, TouchPhase::down, at_mm)});
        show({touch(99, TouchPhase::move, at_mm)});
        show({touch(99, TouchPhase::up, at_mm)});
        for (int i = 0; i < 8; ++i) show();  // the glow of a button fades
        return present();
    }

    style::Color color_lit_at(const Picture& thrown, const Vector2f& at_mm) const {
        const Vector2f px = 0.5f * (*touchstone::project(model_, T_g_t_ * on_ridge_t_m(at_mm)) +
                                    Vector2f(0.5f, 0.5f));  // pixels of half the size
        return color_at(thrown, static_cast<int>(px.x()), static_cast<int>(px.y()));
    }

    /// Where the menu's handle lies, or a scene's tile once it is open: pixels of the view are millimetres.
    Vector2f menu_place_mm(const std::string& scene) {
        const TableFrame above = seen_from_above(frame_, view_);
        const SurfaceGeometry surface(above, view_.size_px());
        const Layout layout = make_projected_layout(view_.size_px(), view_.size_px());
        Canvas canvas;
        canvas.begin({600.f, 400.f}, layout.scale);
        TouchMenu menu(scene_names(ScenePlace::surface));
        menu.draw(canvas, layout.view, surface, "");
        const Vector2f handle = menu.handle_px().center();
        if (scene.empty()) return handle;
        TouchEvent event;
        event.tip.pixel_px = handle;
        menu.on_touch(event);
        menu.update(1);
        menu.draw(canvas, layout.view, surface, "");
        return menu.place_px(scene).center();
    }

    static int count_lit(const Picture& thrown) {
        int lit = 0;
        for (std::size_t i = 0; i < thrown.rgba.size(); i += 4)
            lit += std::max({thrown.rgba[i], thrown.rgba[i + 1], thrown.rgba[i + 2]}) > 60 ? 1 : 0;
        return lit;
    }

    PresenterConfig config_;
    ViewFromAbove view_ = make_view_from_above(frame_.area, frame_.T_g_c);
    std::unique_ptr<TablePresenter> presenter_;
};

TEST_F(ProjectedPresenterTest, PaintIsLitUnderTheFingerInItsFullColour) {
    const Vector2f a(120.f, 120.f), b(460.f, 260.f);
    const Picture thrown = stroke(1, a, b);
    for (int i = 0; i <= 10; ++i) {
        const Vector2f at = a + 0.1f * static_cast<float>(i) * (b - a);
        EXPECT_LE(difference(color_lit_at(thrown, at), style::finger_color(1)), 12) << i;
    }
    const float radius_mm = 0.5f * style::stroke_widths_mm[1];
    const Vector2f aside = (radius_mm + 3.f) * Vector2f(-(b - a).y(), (b - a).x()).normalized();
    EXPECT_EQ(color_lit_at(thrown, 0.5f * (a + b) + aside), style::no_light);
}

TEST_F(ProjectedPresenterTest, ATableWithoutPaintIsDarkButForItsControls) {
    const Picture thrown = present();
    EXPECT_EQ(color_lit_at(thrown, {300.f, 200.f}), style::no_light);
    EXPECT_EQ(color_lit_at(thrown, {3.f, 200.f}), style::no_light) << "no outline";
    EXPECT_LT(count_lit(thrown), display_size.width_px * display_size.height_px / 50);
}

TEST_F(ProjectedPresenterTest, WordsComeWhenSomethingIsWrong) {
    const Picture well = present();
    frame_.note = "The camera was knocked";
    const Picture wrong = present();
    EXPECT_GT(count_differences(well, wrong, 60), 50);
    int elsewhere = 0;
    for_each_difference(well, wrong, 60, [&](int x, int y) {
        const auto lit = test::lit_point_g_m(model_, model_place(wrong, x, y), view_.area_g);
        const Vector2f uv = area_uv(view_.area_g, *lit);
        elsewhere += uv.x() > 0.45f || uv.y() > 0.3f ? 1 : 0;
    });
    EXPECT_EQ(elsewhere, 0);
}

TEST_F(ProjectedPresenterTest, TheMenuIsTouchedWhereItIsLit) {
    tap(menu_place_mm(""));
    tap(menu_place_mm("photos"));
    EXPECT_EQ(presenter_->scene_name(), "photos");
}

TEST_F(ProjectedPresenterTest, ScenesForScreensAreNotOffered) {
    const auto names = scene_names(ScenePlace::surface);
    EXPECT_EQ(names, (std::vector<std::string>{"paint", "particles", "photos", "attract"}));
    EXPECT_THROW(open("mirror"), Error);
}

TEST_F(ProjectedPresenterTest, EverySceneWorks) {
    auto particles = std::make_shared<ParticleView>();
    particles->intrinsics = frame_.intrinsics;
    particles->radius_m = 0.015f;
    const RigidTransform T_c_t = frame_.T_g_c.inverse() * T_g_t_;
    const Vector3f ball_t_m = on_ridge_t_m({300.f, 150.f}) - Vector3f(0.f, 0.f, 0.015f);
    particles->spheres.push_back({T_c_t * ball_t_m, T_c_t * on_ridge_t_m({300.f, 150.f}), 1.f, 0});
    frame_.particles = particles;
    for (const std::string& scene : scene_names(ScenePlace::surface)) {
        open(scene);
        for (int i = 0; i < 15; ++i) show();
        EXPECT_GT(count_lit(present()), 75) << scene;
        if (scene == "particles") {
            EXPECT_NE(color_lit_at(present(), {300.f, 150.f}), style::no_light);
        }
    }
}

TEST_F(ProjectedPresenterTest, BeforeTheScanItTellsWhatHappens) {
    ProjectedDisplay display(*projector_);
    TablePresenter presenter(display, "paint", config_);
    TableFrame starting;
    starting.state = "scanning";
    starting.scan_progress = 0.4f;
    presenter.present(seen_from_above(starting, ViewFromAbove{}), 0.03f);
    EXPECT_GT(count_lit(display.read_pixels()), 100);
    EXPECT_EQ(take_gl_errors(), "");
}

/// For people: TOUCHSTONE_PICTURES names a folder for what the projector throws.
TEST_F(ProjectedPresenterTest, ForPeopleToLookAt) {
    const char* const folder = std::getenv("TOUCHSTONE_PICTURES");
    if (folder == nullptr) GTEST_SKIP() << "TOUCHSTONE_PICTURES is not set";
    const auto save = [&](const Picture& shown, const std::string& name) {
        Image8 image{shown.width_px, shown.height_px, 3, {}};
        for (std::size_t i = 0; i < shown.rgba.size(); ++i)
            if (i % 4 != 3) image.pixels.push_back(shown.rgba[i]);
        write_png(std::filesystem::path(folder) / (name + ".png"), image);
    };
    for (int i = 0; i < 6; ++i)
        stroke(i, {60.f, 100.f + 35.f * static_cast<float>(i)},
               {540.f, 100.f + 35.f * static_cast<float>(i)});
    frame_.note = "The camera was knocked; touches may be off";
    save(present(), "projected_paint");
    save(tap(menu_place_mm("")), "projected_menu");
    tap(menu_place_mm("photos"));
    for (int i = 0; i < 15; ++i) show();
    save(present(), "projected_photos");
}

}  // namespace
}  // namespace touchstone
