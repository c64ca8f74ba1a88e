// The scene that turns the scan: what it wishes to see when it is touched, and that what comes is shown.
#include "scene_fixture.hpp"

namespace touchstone {
namespace {

class InspectTest : public SceneFixture {
  protected:
    InspectTest() { open("inspect"); }

    ViewWish wish() const {
        const auto view = presenter_->wish().view;
        EXPECT_TRUE(view.has_value());
        return view.value_or(ViewWish{});
    }
    void answer(style::Color color, bool has_colors = false) {
        auto rendered = std::make_shared<RenderedView>();
        rendered->version = wish().version;
        rendered->is_full_quality = true;
        rendered->has_colors = has_colors;
        rendered->picture = {view_size.width_px, view_size.height_px, {}};
        for (int i = 0; i < view_size.width_px * view_size.height_px; ++i)
            rendered->picture.rgba.insert(rendered->picture.rgba.end(), {color.r, color.g, color.b, 255});
        frame_.rendered = rendered;
    }
    /// The middle of a button of the row at the foot of the area, by its number.
    Eigen::Vector2f button_px(int number) const {
        ButtonRow row(RowEdge::bottom);
        std::vector<Button> buttons(4);
        const std::array labels{"Shaded", "Normals", "Colours", "Hands"};
        for (std::size_t i = 0; i < 4; ++i) {
            buttons[i].id = static_cast<int>(i);
            buttons[i].label = labels[i];
        }
        row.set(buttons);
        const Layout layout = make_layout(display_size, view_size);
        Canvas canvas;
        canvas.begin({960.f, 600.f}, layout.scale);
        row.lay_out(canvas, layout.view, SurfaceGeometry(frame_, view_size));
        return row.place_px(number).center();
    }
    const Eigen::Vector2f middle_px_{159.5f, 119.5f};
};

TEST_F(InspectTest, WishesTheCamerasViewFirstAndShowsWhatComes) {
    ASSERT_TRUE(wish().T_g_v);
    EXPECT_TRUE(wish().T_g_v->isApprox(frame_.T_g_c, 1e-5f));
    EXPECT_EQ(wish().style, ViewStyle::shaded);
    answer({200, 40, 90});
    present();
    const style::Color shown = color_at_view(present(), middle_px_);
    EXPECT_NEAR(shown.r, 200, tolerance);
    EXPECT_NEAR(shown.g, 40, tolerance);
    EXPECT_NEAR(shown.b, 90, tolerance);
}

TEST_F(InspectTest, AFingerTurnsItAndTheWishRestsAfterwards) {
    pass(0.5f);
    EXPECT_FALSE(wish().moving);
    const int before = wish().version;
    present({touch(1, TouchPhase::down, middle_px_)});
    for (int i = 1; i <= 8; ++i)
        present({touch(1, TouchPhase::move, middle_px_ + Eigen::Vector2f(6.f * static_cast<float>(i), 0.f))});
    EXPECT_GT(wish().version, before);
    EXPECT_TRUE(wish().moving);
    EXPECT_FALSE(wish().T_g_v->isApprox(frame_.T_g_c, 1e-2f));
    present({touch(1, TouchPhase::up, middle_px_ + Eigen::Vector2f(48.f, 0.f))});
    pass(0.5f);
    const int rested = wish().version;
    EXPECT_FALSE(wish().moving);
    pass(0.5f);
    EXPECT_EQ(wish().version, rested) << "a view that rests is not rendered again";
}

/// Nothing jumps when fingers come and go: from frame to frame the view moves no more than fingers do.
TEST_F(InspectTest, ASecondFingerComesAndGoesWithoutAJump) {
    pass(0.2f);
    RigidTransform last = *wish().T_g_v;
    float largest_m = 0.f;
    const auto look = [&] {
        largest_m = std::max(largest_m, (wish().T_g_v->translation() - last.translation()).norm());
        last = *wish().T_g_v;
    };
    const Eigen::Vector2f a(140.f, 110.f), b(200.f, 150.f);
    present({touch(1, TouchPhase::down, a)});
    for (int i = 0; i < 30; ++i) {
        const Eigen::Vector2f step(static_cast<float>(i), 0.f);
        std::vector<TouchEvent> touches{touch(1, TouchPhase::move, a + step)};
        if (i == 10) touches.push_back(touch(2, TouchPhase::down, b));
        if (i > 10 && i < 20) touches.push_back(touch(2, TouchPhase::move, b));
        if (i == 20) touches.push_back(touch(2, TouchPhase::up, b));
        present(touches);
        look();
    }
    EXPECT_GT(largest_m, 0.f);
    EXPECT_LT(largest_m, 0.06f)
        << "one pixel is 10 mrad of a turn or 4 mm of a move; a finger leaves its tap "
           "radius with 5";
}

TEST_F(InspectTest, ADoubleTapBringsItBack) {
    stroke(middle_px_, middle_px_ + Eigen::Vector2f(40.f, 20.f));
    EXPECT_FALSE(wish().T_g_v->isApprox(frame_.T_g_c, 1e-2f));
    tap(middle_px_);
    pass(0.15f);  // longer than a touch that drops out
    tap(middle_px_);
    pass(0.3f);
    EXPECT_TRUE(wish().T_g_v->isApprox(frame_.T_g_c, 1e-4f));
}

TEST_F(InspectTest, ButtonsChooseTheStyleAndColoursOnlyWhereThereAreSome) {
    tap(button_px(1));
    EXPECT_EQ(wish().style, ViewStyle::normals);
    tap(button_px(2));
    EXPECT_EQ(wish().style, ViewStyle::normals) << "the scan keeps no colours";
    answer({90, 90, 90}, true);
    present();
    tap(button_px(2));
    EXPECT_EQ(wish().style, ViewStyle::colors);
    tap(button_px(3));
    EXPECT_EQ(wish().style, ViewStyle::foreground);
    EXPECT_TRUE(wish().T_g_v->isApprox(frame_.T_g_c, 1e-5f)) << "a finger on a button turns nothing";
}

TEST_F(InspectTest, ANewScanIsSeenFromTheCameraAgain) {
    stroke(middle_px_, middle_px_ + Eigen::Vector2f(40.f, 0.f));
    frame_.state = "scanning";
    present();
    EXPECT_FALSE(presenter_->wish().view.has_value());
    frame_.state = "live";
    present();
    EXPECT_TRUE(wish().T_g_v->isApprox(frame_.T_g_c, 1e-5f));
}

}  // namespace
}  // namespace touchstone
