// The touch menu as people use it, on the whole table.
#include "ui/touch_menu.hpp"

#include "scene_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

class TouchMenuTest : public SceneFixture {
  protected:
    TouchMenuTest() { open("paint"); }
    void open_menu() { tap(menu_tile_px("")); }
    /// Pixels that a stroke across the middle has changed.
    int painted() {
        pass(0.3f);
        const Picture before = present();
        return count_differences(before, stroke({120.f, 120.f}, {200.f, 130.f}), 40);
    }
};

TEST_F(TouchMenuTest, TheHandleLiesInTheAreaAndIsLargeEnough) {
    const SurfaceGeometry surface(frame_, view_size);
    EXPECT_TRUE(surface.room().box_px().contains(menu_tile_px("")));
    for (const std::string& scene : scene_names())
        EXPECT_TRUE(surface.room().box_px().contains(menu_tile_px(scene))) << scene;
}

TEST_F(TouchMenuTest, AChoiceChangesTheSceneAndWhatThePipelineIsAskedFor) {
    EXPECT_FALSE(presenter_->wish().particles);
    open_menu();
    tap(menu_tile_px("particles"));
    EXPECT_EQ(presenter_->scene_name(), "particles");
    EXPECT_TRUE(presenter_->wish().particles);
    open_menu();
    tap(menu_tile_px("photos"));
    EXPECT_EQ(presenter_->scene_name(), "photos");
    EXPECT_FALSE(presenter_->wish().particles);
}

TEST_F(TouchMenuTest, EverySceneCanBeChosenAndLeft) {
    for (const std::string& scene : scene_names()) {
        open_menu();
        tap(menu_tile_px(scene));
        EXPECT_EQ(presenter_->scene_name(), scene);
    }
}

TEST_F(TouchMenuTest, TheFingerThatChoseDoesNothingInTheNewScene) {
    open_menu();
    tap(menu_tile_px("photos"));
    open_menu();
    const Vector2f place = menu_tile_px("paint");
    present({touch(90, TouchPhase::down, place)});
    const Picture before = present();
    EXPECT_EQ(presenter_->scene_name(), "paint");
    for (int i = 1; i <= 10; ++i)
        present({touch(90, TouchPhase::move, place + Vector2f(0.f, 8.f * static_cast<float>(i)))});
    const Picture after = present({touch(90, TouchPhase::up, place + Vector2f(0.f, 80.f))});
    EXPECT_LE(difference(color_at_view(after, place + Vector2f(0.f, 50.f)),
                         color_at_view(before, place + Vector2f(0.f, 50.f))),
              tolerance);
}

/// Pictures are rendered once for a version: no two scenes may wish for different ones under the same, and
/// what the old one wished for is not shown in the new one.
TEST_F(TouchMenuTest, TheNewSceneWishesForPicturesOfItsOwn) {
    open("mirror");
    pass(0.3f);
    const int of_mirror = presenter_->wish().view.value().version;
    auto rendered = std::make_shared<RenderedView>();
    rendered->version = of_mirror;
    rendered->picture = {view_size.width_px, view_size.height_px, {}};
    for (int i = 0; i < view_size.width_px * view_size.height_px; ++i)
        rendered->picture.rgba.insert(rendered->picture.rgba.end(), {200, 0, 0, 255});
    frame_.rendered = rendered;
    EXPECT_LT(color_at_view(present(), {60.f, 150.f}).g, 20);
    open_menu();
    tap(menu_tile_px("inspect"));
    pass(0.1f);
    EXPECT_EQ(presenter_->scene_name(), "inspect");
    EXPECT_GT(presenter_->wish().view.value().version, of_mirror);
    EXPECT_GT(color_at_view(present(), {60.f, 150.f}).g, 200) << "the table, not the old picture";
}

TEST_F(TouchMenuTest, ATouchElsewhereClosesItAndPaintsNothing) {
    const Picture closed = present();
    open_menu();
    EXPECT_GT(count_differences(closed, present(), 40), 500);
    tap({160.f, 130.f});
    pass(0.3f);
    EXPECT_EQ(count_differences(closed, present(), tolerance), 0);
    EXPECT_GT(painted(), 100) << "the next one does";
}

TEST_F(TouchMenuTest, ItClosesByItself) {
    const Picture closed = present();
    open_menu();
    pass(5.f);
    EXPECT_GT(count_differences(closed, present(), 40), 500);
    pass(1.5f);
    EXPECT_EQ(count_differences(closed, present(), tolerance), 0);
}

TEST_F(TouchMenuTest, WithoutItTheHandleIsSurfaceLikeAnyOther) {
    PresenterConfig config;
    config.menu = false;
    const Vector2f handle = menu_tile_px("");
    open("paint", config);
    EXPECT_EQ(color_at_view(present(), handle), style::white);
    stroke(handle - Vector2f(20.f, 0.f), handle + Vector2f(20.f, 0.f));
    EXPECT_NE(color_at_view(present(), handle), style::white);
}

}  // namespace
}  // namespace touchstone
