// A table with named areas, as people use it.
#include "scene_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

class SplitSceneTest : public SceneFixture {
  protected:
    SplitSceneTest() {
        frame_.areas = {part("left", {{20, 20}, {150, 20}, {150, 220}, {20, 220}}),
                        part("right", {{170, 20}, {300, 20}, {300, 220}, {170, 220}})};
    }
    ShownArea part(const std::string& name, const std::vector<Vector2f>& corners_px,
                   const std::string& scene = "") const {
        ShownArea area;
        area.name = name;
        area.scene = scene;
        area.triangles = {0, 1, 2, 2, 3, 0};
        area.corners_px = corners_px;
        for (const Vector2f& corner : corners_px)
            area.corners_c_m.push_back(back_project(frame_.intrinsics, corner.x(), corner.y(), table_m));
        area.area = {area.corners_c_m[0], area.corners_c_m[1] - area.corners_c_m[0],
                     area.corners_c_m[3] - area.corners_c_m[0]};
        for (std::size_t i = 0; i < 4; ++i) area.area_px[i] = corners_px[i];
        return area;
    }
    /// A stroke that keeps the area in which it begins.
    Picture paint(const Vector2f& from, const Vector2f& to, int area) {
        const int id = ++ids_given_;
        for (int i = 0; i <= 10; ++i) {
            TouchEvent event = touch(id, i == 0 ? TouchPhase::down : TouchPhase::move,
                                     from + 0.1f * static_cast<float>(i) * (to - from));
            event.tip.area = area;
            present({event});
        }
        TouchEvent event = touch(id, TouchPhase::up, to);
        event.tip.area = area;
        present({event});
        pass(0.5f);
        return present();
    }
    bool is_painted(const Picture& picture, const Vector2f& place_px) const {
        return difference(color_at_view(picture, place_px), style::white) > 40;
    }
};

TEST_F(SplitSceneTest, WhatIsPaintedInOneAreaEndsAtItsSide) {
    open("paint");
    const Picture after = paint({80, 60}, {240, 60}, 0);
    EXPECT_TRUE(is_painted(after, {100, 60}));
    EXPECT_TRUE(is_painted(after, {145, 60}));
    EXPECT_FALSE(is_painted(after, {160, 60})) << "between the areas";
    EXPECT_FALSE(is_painted(after, {220, 60})) << "in the other area";
}

TEST_F(SplitSceneTest, FingersInNoAreaDoNothing) {
    open("paint");
    const Picture before = present();
    EXPECT_LT(count_differences(before, paint({80, 60}, {240, 60}, -1), 40), 10);
}

TEST_F(SplitSceneTest, EachAreaHasControlsOfItsOwn) {
    open("paint");
    const Picture picture = present();
    int left = 0, right = 0;
    for (int y = 150; y < 220; ++y)
        for (int x = 20; x < 300; ++x)
            (x < 160 ? left : right) += is_painted(picture, {static_cast<float>(x), static_cast<float>(y)});
    EXPECT_GT(left, 500);
    EXPECT_NEAR(right, left, 200);
}

TEST_F(SplitSceneTest, AnAreaThatChangesLeavesTheOthersAsTheyAre) {
    open("paint");
    paint({60, 60}, {120, 60}, 0);
    paint({200, 60}, {260, 60}, 1);
    frame_.areas[1].scene = "photos";
    pass(0.2f);
    const Picture after = present();
    EXPECT_TRUE(is_painted(after, {100, 60}));
    frame_.areas.pop_back();
    pass(0.2f);
    const Picture alone = present();
    EXPECT_TRUE(is_painted(alone, {100, 60}));
    EXPECT_FALSE(is_painted(alone, {240, 60}));
}

TEST_F(SplitSceneTest, AFingerThatIsDownWhileAreasChangeEndsItsStroke) {
    open("paint");
    TouchEvent event = touch(90, TouchPhase::down, {60, 60});
    event.tip.area = 0;
    present({event});
    frame_.areas.pop_back();
    event.phase = TouchPhase::move;
    present({event});
    event.tip.pixel_px = {120, 120};
    event.tip.surface_c_m = back_project(frame_.intrinsics, 120, 120, table_m);
    const Picture before = present({event});
    EXPECT_FALSE(is_painted(before, {90, 90}));
    event.phase = TouchPhase::up;
    present({event});
}

TEST_F(SplitSceneTest, WithoutAreasTheTableIsOneAgain) {
    open("paint");
    frame_.areas.clear();
    pass(0.2f);
    EXPECT_TRUE(is_painted(stroke({120, 60}, {200, 60}), {160, 60}));
}

TEST_F(SplitSceneTest, WishesAreThoseOfTheAreas) {
    frame_.areas[0].scene = "particles";
    frame_.areas[1].scene = "inspect";
    open("paint");
    EXPECT_TRUE(presenter_->wish().particles);
    ASSERT_TRUE(presenter_->wish().view);
    const int version = presenter_->wish().view->version;
    frame_.areas[1].scene = "mirror";
    pass(0.2f);
    ASSERT_TRUE(presenter_->wish().view);
    EXPECT_GT(presenter_->wish().view->version, version) << "no picture of the old one is the new one's";
    frame_.areas[1].scene = "paint";
    pass(0.2f);
    EXPECT_FALSE(presenter_->wish().view);
}

}  // namespace
}  // namespace touchstone
