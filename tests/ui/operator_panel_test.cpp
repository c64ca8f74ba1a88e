// The operator's panel as people use it, on the whole table.
#include "ui/operator_panel.hpp"

#include "scene_fixture.hpp"
#include "ui/operator_card.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

class OperatorPanelTest : public SceneFixture {
  protected:
    OperatorPanelTest() {
        auto view = std::make_shared<OperatorView>();
        view->camera = "Kinect v1";
        view->device = "a device";
        view->camera_rate_hz = 30.f;
        view->stages = {{"touch detection", 3.5, 5.25, 300}, {"raycast", 4.5, 6.f, 300}};
        view->faults = {"14:03:12 silent: the depth camera gives nothing"};
        view->can_record = true;
        view->depth = {{4, 3}, std::vector<std::uint8_t>(12, 120)};
        view->mask = {{4, 3}, {255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
        frame_.operating = view;
        open("paint");
    }

    Vector2f corner_px(float inwards_mm = 15.f) const {
        const Vector2f inwards = (frame_.area_px[2] - frame_.area_px[0]).normalized();
        return frame_.area_px[0] +
               inwards * inwards_mm / SurfaceGeometry(frame_, view_size).mm_per_px({160, 120});
    }
    /// Where the panel draws a button.
    Eigen::AlignedBox2f button_px(OperatorButton button) const {
        const Layout layout = make_layout(display_size, view_size);
        Canvas canvas;
        canvas.begin({960.f, 600.f}, layout.scale);
        OperatorPanel panel;
        panel.toggle();
        panel.update(frame_, SurfaceGeometry(frame_, view_size));
        panel.draw(canvas, layout.view, SurfaceGeometry(frame_, view_size), frame_);
        return panel.place_px(button);
    }
    void open_by_touch() { tap(corner_px(), 2.2f); }
    void press(OperatorButton button, float seconds = 0.1f) { tap(button_px(button).center(), seconds); }
    bool is_open() const { return presenter_->operator_wish().open; }
    int painted() {
        pass(0.3f);
        const Picture before = present();
        return count_differences(before, stroke({120.f, 120.f}, {200.f, 130.f}), 40);
    }
};

TEST_F(OperatorPanelTest, AFingerThatRestsInACornerOpensIt) {
    tap(corner_px(), 1.7f);
    EXPECT_FALSE(is_open());
    open_by_touch();
    EXPECT_TRUE(is_open());
    press(OperatorButton::close);
    EXPECT_FALSE(is_open());
}

TEST_F(OperatorPanelTest, FingersElsewhereOrThatMoveDoNot) {
    tap({160.f, 120.f}, 2.5f);
    tap(corner_px(150.f), 2.5f);
    EXPECT_FALSE(is_open());
    present({touch(70, TouchPhase::down, corner_px())});
    for (int i = 0; i < 90; ++i)
        present({touch(70, TouchPhase::move, corner_px(15.f + 1.5f * static_cast<float>(i % 30)))});
    present({touch(70, TouchPhase::up, corner_px())});
    EXPECT_FALSE(is_open());
}

TEST_F(OperatorPanelTest, TheFingerThatOpensItAndThoseOnItDoNothingToTheScene) {
    present({touch(70, TouchPhase::down, corner_px())});
    for (int i = 0; i < 70; ++i) present({touch(70, TouchPhase::move, corner_px())});
    ASSERT_TRUE(is_open());
    for (int i = 1; i < 20; ++i)
        present({touch(70, TouchPhase::move, corner_px(15.f + 10.f * static_cast<float>(i)))});
    stroke({120.f, 120.f}, {200.f, 130.f});
    const Vector2f close = button_px(OperatorButton::close).center();
    present({touch(71, TouchPhase::down, close)});
    present({touch(70, TouchPhase::move, {160.f, 100.f}), touch(71, TouchPhase::move, close)});
    ASSERT_FALSE(is_open());
    const Picture before = present();
    present({touch(70, TouchPhase::move, {220.f, 140.f}), touch(71, TouchPhase::move, {100.f, 100.f})});
    present({touch(70, TouchPhase::up, {220.f, 140.f}), touch(71, TouchPhase::up, {100.f, 100.f})});
    pass(0.3f);
    const Picture after = present();
    for (const Vector2f& place : {Vector2f(160.f, 125.f), Vector2f(220.f, 140.f), Vector2f(100.f, 100.f)})
        EXPECT_LE(difference(color_at_view(after, place), color_at_view(before, place)), tolerance);
    EXPECT_GT(painted(), 100) << "the next finger paints";
}

TEST_F(OperatorPanelTest, ButtonsAskForWhatTheySay) {
    open_by_touch();
    press(OperatorButton::rescan);
    EXPECT_EQ(presenter_->operator_wish().rescans, 0) << "it is held, not tapped";
    press(OperatorButton::rescan, 1.f);
    press(OperatorButton::record);
    EXPECT_EQ(presenter_->operator_wish().rescans, 1);
    EXPECT_EQ(presenter_->operator_wish().recordings, 1);
    EXPECT_TRUE(is_open());
    press(OperatorButton::recalibrate, 1.f);
    EXPECT_EQ(presenter_->operator_wish().recalibrations, 1);
    EXPECT_FALSE(is_open()) << "the crosses lie under it";
}

TEST_F(OperatorPanelTest, OnlyAProjectorIsCalibrated) {
    open_by_touch();
    pass(0.3f);
    EXPECT_TRUE(button_px(OperatorButton::calibrate_projector).isEmpty());
    auto with = std::make_shared<OperatorView>(*frame_.operating);
    with->can_calibrate_projector = true;
    frame_.operating = with;
    pass(0.3f);
    press(OperatorButton::calibrate_projector);
    EXPECT_EQ(presenter_->operator_wish().projector_calibrations, 0) << "it is held, not tapped";
    press(OperatorButton::calibrate_projector, 1.f);
    EXPECT_EQ(presenter_->operator_wish().projector_calibrations, 1);
    EXPECT_FALSE(is_open()) << "its patterns lie under it";
}

TEST_F(OperatorPanelTest, WhereNothingIsRecordedTheButtonIsDead) {
    auto without = std::make_shared<OperatorView>(*frame_.operating);
    without->can_record = false;
    frame_.operating = without;
    open_by_touch();
    press(OperatorButton::record);
    EXPECT_EQ(presenter_->operator_wish().recordings, 0);
}

TEST_F(OperatorPanelTest, ButtonsAreLargeEnoughUnderAnyCamera) {
    const Layout layout = make_layout(display_size, {640, 480});
    Canvas canvas;
    canvas.begin({960.f, 600.f}, layout.scale);
    for (const float camera_m : {0.7f, 1.1f, 1.4f}) {
        TableFrame frame;
        frame.intrinsics = {575.f, 575.f, 319.5f, 239.5f, 640, 480, {0, 0}};
        const SurfaceGeometry surface(frame, {640, 480});
        OperatorPanel panel;
        panel.draw(canvas, layout.view, surface, frame);
        for (const auto button : {OperatorButton::rescan, OperatorButton::recalibrate, OperatorButton::record,
                                  OperatorButton::close}) {
            const Eigen::AlignedBox2f place = panel.place_px(button);
            EXPECT_GE(place.sizes().minCoeff() * surface.mm_per_px(place.center()), least_button_mm - 0.1f)
                << camera_m;
        }
    }
}

TEST_F(OperatorPanelTest, ShowsDepthAndForeground) {
    open_by_touch();
    pass(0.3f);
    const Picture picture = present();
    const Layout layout = make_layout(display_size, view_size);
    Canvas canvas;
    canvas.begin({960.f, 600.f}, layout.scale);
    const float bottom = layout.view.to_display(button_px(OperatorButton::close).min()).y();
    int of_depth = 0, of_mask = 0;
    for (int y = static_cast<int>(layout.view.rect.min_px.y()); y < static_cast<int>(bottom) - 20; ++y) {
        for (int x = static_cast<int>(layout.view.rect.center_px().x()); x < display_size.width_px; ++x) {
            if (x >= static_cast<int>(layout.view.rect.max_px.x()) - 20) break;
            of_depth += color_at(picture, x, y) == style::Color{120, 120, 120} ? 1 : 0;
            of_mask += color_at(picture, x, y) == style::white ? 1 : 0;
        }
    }
    EXPECT_GT(of_depth, 5000) << "all of one picture";
    EXPECT_GT(of_mask, 300) << "a twelfth of the other, less where it fades";
    EXPECT_LT(of_mask, of_depth / 6);
}

TEST_F(OperatorPanelTest, ItClosesByItselfAfterAMinuteButNotWhileTheTableWaits) {
    open_by_touch();
    frame_.state = "sensor_lost";
    pass(5.f);
    EXPECT_TRUE(is_open());
    frame_.state = "live";
    frame_.timestamp_us += 56'000'000;
    present();
    EXPECT_FALSE(is_open());
}

/// Off screen, with a keyboard.
class KeyedDisplay : public Display {
  public:
    PixelSize size_px() const override { return screen_->size_px(); }
    void begin_frame() override { screen_->begin_frame(); }
    void present() override { screen_->present(); }
    Picture read_pixels() override { return screen_->read_pixels(); }
    bool should_close() override { return false; }
    std::optional<char> take_key() override { return std::exchange(key_, std::nullopt); }
    void press(char key) { key_ = key; }

  private:
    std::unique_ptr<Display> screen_ = make_headless_display({960, 600});
    std::optional<char> key_;
};

TEST_F(OperatorPanelTest, TheKeyOOpensAndClosesIt) {
    presenter_.reset();
    display_.reset();
    KeyedDisplay keyed;
    TablePresenter presenter(keyed, "paint");
    for (const bool open : {true, false, true}) {
        keyed.press('o');
        presenter.present(frame_, 0.03f);
        EXPECT_EQ(presenter.operator_wish().open, open);
    }
    keyed.press('x');
    presenter.present(frame_, 0.03f);
    EXPECT_TRUE(presenter.operator_wish().open);
    EXPECT_EQ(take_gl_errors(), "");
}

}  // namespace
}  // namespace touchstone
