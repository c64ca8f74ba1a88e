// Named areas, made and changed by touch from the operator's panel.
#include "ui/area_editor.hpp"

#include <gmock/gmock.h>

#include "scene_fixture.hpp"
#include "ui/operator_panel.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class AreaEditorTest : public SceneFixture {
  protected:
    AreaEditorTest() { tell(); }

    /// What the perception loop says from now on.
    void tell(const std::string& refusal = "") {
        auto view = std::make_shared<OperatorView>();
        view->can_change_areas = true;
        view->area_lists = wish_.area_lists;
        view->areas = refusal;
        frame_.operating = view;
    }
    Vector2f pixel_at(const Vector2f& uv) const {
        return frame_.area_px[0] + uv.x() * (frame_.area_px[1] - frame_.area_px[0]) +
               uv.y() * (frame_.area_px[3] - frame_.area_px[0]);
    }
    ShownArea shown(const std::string& name, const std::vector<Vector2f>& corners_uv,
                    const std::string& scene = "") const {
        ShownArea area{name, scene, {}, {}, {0, 1, 2}, frame_.area, frame_.area_px};
        for (const Vector2f& uv : corners_uv) {
            area.corners_px.push_back(pixel_at(uv));
            area.corners_c_m.push_back(
                back_project(frame_.intrinsics, pixel_at(uv).x(), pixel_at(uv).y(), table_m));
        }
        return area;
    }

    bool see() {
        ++frame_.index;
        frame_.timestamp_us += 33'333;
        canvas_.begin({960.f, 600.f}, layout_.scale);
        const bool stays = editor_.update(frame_, *frame_.operating, wish_);
        editor_.draw(canvas_, layout_.view, SurfaceGeometry(frame_, view_size));
        return stays;
    }
    void touch_at(const Vector2f& uv, int area = -1, std::optional<Vector2f> from_uv = {}) {
        const int id = ++ids_given_;
        for (const TouchPhase phase : {TouchPhase::down, TouchPhase::move, TouchPhase::up}) {
            const Vector2f at = phase == TouchPhase::down && from_uv ? *from_uv : uv;
            TouchEvent event = touch(id, phase, pixel_at(at));
            event.tip.area_uv = at;
            event.tip.area = area;
            editor_.on_touch(event);
            see();
        }
    }
    /// Whether it stays.
    bool press(AreaButton button, float seconds = 0.f) {
        see();
        const Vector2f place = editor_.place_px(button).center();
        const int id = ++ids_given_;
        editor_.on_touch(touch(id, TouchPhase::down, place));
        bool stays = see();
        for (int i = 0; i < static_cast<int>(30.f * seconds); ++i) stays = see() && stays;
        editor_.on_touch(touch(id, TouchPhase::up, place));
        for (int i = 0; i < 5; ++i) stays = see() && stays;  // a press at once would be the same
        return stays;
    }
    bool has(AreaButton button) {
        see();
        return !editor_.place_px(button).isEmpty();
    }

    OperatorWish wish_;
    Layout layout_ = make_layout(display_size, view_size);
    Canvas canvas_;
    AreaEditor editor_{scene_names()};
};

TEST_F(AreaEditorTest, CornersAreTouchedInOrderAndTheFirstOnceMoreFinishes) {
    see();
    touch_at({0.1f, 0.1f});
    touch_at({0.4f, 0.1f}, -1, Vector2f(0.35f, 0.2f));
    EXPECT_TRUE(has(AreaButton::finish));
    touch_at({0.1f, 0.11f});
    EXPECT_EQ(wish_.area_lists, 0) << "the first corner again, but two are no area";
    press(AreaButton::undo);
    touch_at({0.4f, 0.5f});
    touch_at({0.11f, 0.1f});
    ASSERT_EQ(wish_.area_lists, 1);
    ASSERT_THAT(wish_.areas, SizeIs(1));
    EXPECT_EQ(wish_.areas[0].name, "") << "a new one";
    EXPECT_THAT(wish_.areas[0].corners_uv,
                ElementsAre(Vector2f(0.1f, 0.1f), Vector2f(0.4f, 0.1f), Vector2f(0.4f, 0.5f)))
        << "where fingers left";
}

TEST_F(AreaEditorTest, TheButtonFinishesToo) {
    see();
    touch_at({0.1f, 0.1f});
    press(AreaButton::finish);
    touch_at({0.4f, 0.1f});
    press(AreaButton::finish);
    EXPECT_EQ(wish_.area_lists, 0) << "two corners are no area";
    touch_at({0.4f, 0.5f});
    press(AreaButton::finish);
    EXPECT_EQ(wish_.area_lists, 1);
    press(AreaButton::finish);
    EXPECT_EQ(wish_.area_lists, 1) << "there is nothing to finish";
}

TEST_F(AreaEditorTest, OneThatIsThereIsChosenByTouchAndGetsTheNextScene) {
    frame_.areas = {shown("left", {{0.f, 0.f}, {0.5f, 0.f}, {0.f, 1.f}}),
                    shown("right", {{1.f, 0.f}, {0.6f, 0.f}, {1.f, 1.f}}, "particles")};
    see();
    EXPECT_FALSE(has(AreaButton::scene)) << "none is chosen";
    touch_at({0.1f, 0.1f}, 0);
    std::vector<std::string> given;
    for (int i = 0; i < 6; ++i) {
        press(AreaButton::scene);
        ASSERT_EQ(wish_.area_lists, i + 1);
        ASSERT_THAT(wish_.areas, SizeIs(2));
        EXPECT_EQ(wish_.areas[0].name, "left");
        EXPECT_THAT(wish_.areas[0].corners_uv, IsEmpty()) << "as they were";
        EXPECT_EQ(wish_.areas[1].scene, "particles");
        given.push_back(wish_.areas[0].scene);
        frame_.areas[0].scene = given.back();
        tell();
    }
    EXPECT_THAT(given, ElementsAre("paint", "mirror", "photos", "inspect", "attract", ""))
        << "all but the one that can be there once only";
}

TEST_F(AreaEditorTest, OneIsRemovedByALongTouch) {
    frame_.areas = {shown("left", {{0.f, 0.f}, {0.5f, 0.f}, {0.f, 1.f}}),
                    shown("right", {{1.f, 0.f}, {0.6f, 0.f}, {1.f, 1.f}}, "paint")};
    see();
    touch_at({0.1f, 0.1f}, 0);
    press(AreaButton::remove);
    EXPECT_EQ(wish_.area_lists, 0) << "it is held, not tapped";
    press(AreaButton::remove, 1.f);
    ASSERT_EQ(wish_.area_lists, 1);
    ASSERT_THAT(wish_.areas, SizeIs(1));
    EXPECT_EQ(wish_.areas[0].name, "right");
    EXPECT_EQ(wish_.areas[0].scene, "paint");
}

TEST_F(AreaEditorTest, NothingIsAskedForUntilTheLastWishIsAnswered) {
    frame_.areas = {shown("left", {{0.f, 0.f}, {0.5f, 0.f}, {0.f, 1.f}})};
    see();
    touch_at({0.1f, 0.1f}, 0);
    press(AreaButton::scene);
    press(AreaButton::scene);
    EXPECT_EQ(wish_.area_lists, 1);
    tell("the scene paint is not there");
    press(AreaButton::scene);
    EXPECT_EQ(wish_.area_lists, 2);
}

TEST_F(AreaEditorTest, ItIsLeftByItsButtonAtEitherEdge) {
    see();
    const float below = editor_.place_px(AreaButton::done).center().y();
    EXPECT_TRUE(press(AreaButton::other_edge));
    see();
    EXPECT_LT(editor_.place_px(AreaButton::done).center().y(), below - 60.f);
    EXPECT_FALSE(press(AreaButton::done));
}

TEST_F(AreaEditorTest, ThePanelOpensItAndTakesAllFingersForIt) {
    open("paint");
    tap(frame_.area_px[0] + Vector2f(6.f, 6.f), 2.2f);
    ASSERT_TRUE(presenter_->operator_wish().open);
    OperatorPanel panel(scene_names());
    panel.toggle();
    panel.update(frame_, SurfaceGeometry(frame_, view_size));
    canvas_.begin({960.f, 600.f}, layout_.scale);
    panel.draw(canvas_, layout_.view, SurfaceGeometry(frame_, view_size), frame_);
    tap(panel.place_px(OperatorButton::areas).center());
    for (const Vector2f& uv : {Vector2f(0.2f, 0.2f), Vector2f(0.6f, 0.2f), Vector2f(0.6f, 0.6f)}) {
        const int id = ++ids_given_;
        for (const TouchPhase phase : {TouchPhase::down, TouchPhase::up}) {
            TouchEvent event = touch(id, phase, pixel_at(uv));
            event.tip.area_uv = uv;
            present({event});
        }
    }
    pass(0.1f);
    tap(pixel_at({0.2f, 0.2f}));
    EXPECT_EQ(presenter_->operator_wish().area_lists, 1);
    EXPECT_TRUE(presenter_->operator_wish().open);
}

}  // namespace
}  // namespace touchstone
