// The paint scene's tools, on the whole table.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <unistd.h>

#include "scene_fixture.hpp"
#include "ui/scenes/paint.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
namespace tool = paint_tool;

class PaintSceneTest : public SceneFixture {
  protected:
    PaintSceneTest() {
        file_ = std::filesystem::temp_directory_path() / ("touchstone_painting" + std::to_string(getpid()));
        std::filesystem::remove(file_);
        open("paint");
    }
    ~PaintSceneTest() override {
        presenter_.reset();
        std::filesystem::remove(file_);
    }

    Vector2f tool_px(int id) {
        const Layout layout = make_layout(display_size, view_size);
        PaintScene scene{SceneSetup{}};
        scene.start(view_size);
        scene.show(frame_);
        Canvas canvas;
        canvas.begin({960.f, 600.f}, layout.scale);
        scene.draw(canvas, layout.view);
        return scene.tools().place_px(id).center();
    }
    void press(int id, float seconds = 0.1f) {
        tap(tool_px(id), seconds);
        pass(0.3f);
    }
    void open_with_file() {
        PresenterConfig config;
        config.scenes.painting_file = file_;
        open("paint", config);
    }
    /// Pixels by which two pictures differ above the tools, of which undo and clear change.
    int differences(const Picture& a, const Picture& b) const {
        int count = 0;
        const float tools_from = make_layout(display_size, view_size).view.to_display({0.f, 196.f}).y();
        const float beside = make_layout(display_size, view_size).view.rect.min_px.x();
        for_each_difference(a, b, tolerance, [&](int x, int y) {
            count += static_cast<float>(y)<tools_from&& static_cast<float>(x)> beside ? 1 : 0;
        });
        return count;
    }

    const Vector2f a_{100.f, 110.f}, b_{220.f, 130.f}, middle_{160.f, 120.f};
    std::filesystem::path file_;
};

TEST_F(PaintSceneTest, AColourButtonGivesEveryFingerThatColour) {
    press(tool::first_color + 4);
    const Picture after = stroke(a_, b_);
    EXPECT_LE(difference(color_at_view(after, middle_), style::palette[4]), tolerance);
    press(tool::each_finger);
    stroke({100.f, 160.f}, {220.f, 160.f});
    EXPECT_LE(difference(color_at_view(present(), {160.f, 160.f}), style::finger_color(ids_given_)),
              tolerance);
}

TEST_F(PaintSceneTest, TheEraserTakesPaintAwayWhereItGoes) {
    press(tool::first_color);
    stroke(a_, b_);
    press(tool::eraser);
    const Picture after = stroke({160.f, 90.f}, {160.f, 150.f});
    EXPECT_EQ(color_at_view(after, middle_), style::white);
    EXPECT_LE(difference(color_at_view(after, {115.f, 112.5f}), style::palette[0]), tolerance);
}

TEST_F(PaintSceneTest, WidthsAreMillimetresOnTheSurface) {
    const float px_per_mm = 290.f / (1000.f * table_m);
    for (std::size_t i = 0; i < style::stroke_widths_mm.size(); ++i) {
        press(tool::first_width + static_cast<int>(i));
        const Picture after = stroke(a_, {220.f, 110.f});
        const float radius_px = 0.5f * style::stroke_widths_mm[i] * px_per_mm;
        EXPECT_NE(color_at_view(after, {160.f, 110.f + radius_px - 0.7f}), style::white) << i;
        EXPECT_EQ(color_at_view(after, {160.f, 110.f + radius_px + 1.2f}), style::white) << i;
        press(tool::undo);
    }
}

TEST_F(PaintSceneTest, UndoGivesThePictureBeforeStrokeByStroke) {
    const Picture empty = present();
    const Picture one = stroke(a_, b_);
    const Picture two = stroke({120.f, 90.f}, {180.f, 160.f}, 3);
    EXPECT_GT(differences(one, two), 300);
    press(tool::undo);
    EXPECT_EQ(differences(present(), one), 0);
    press(tool::undo);
    EXPECT_EQ(differences(present(), empty), 0);
    press(tool::undo);
    EXPECT_EQ(differences(present(), empty), 0);
}

TEST_F(PaintSceneTest, ClearAsksToBeHeldAndCanBeUndone) {
    const Picture empty = present();
    const Picture painted = stroke(a_, b_);
    press(tool::clear, 0.4f);
    EXPECT_EQ(differences(present(), painted), 0) << "let go too soon";
    press(tool::clear, 1.f);
    EXPECT_EQ(differences(present(), empty), 0);
    press(tool::undo);
    EXPECT_EQ(differences(present(), painted), 0);
}

TEST_F(PaintSceneTest, AFingerFromAToolPaintsNothing) {
    const Picture before = present();
    stroke(tool_px(tool::each_finger), middle_);
    EXPECT_EQ(differences(before, present()), 0);
}

/// The camera is pushed 6 cm to its right and turned: the paint is seen where the surface has gone.
TEST_F(PaintSceneTest, PaintStaysOnTheSurfaceWhenTheCameraMoves) {
    press(tool::first_color);
    stroke(a_, b_);
    const Vector3f on_surface = back_project(frame_.intrinsics, middle_.x(), middle_.y(), table_m);
    frame_.T_g_c.translate(Vector3f(0.06f, -0.02f, 0.01f))
        .rotate(Eigen::AngleAxisf(0.12f, Vector3f(0.1f, 0.1f, 1.f).normalized()));
    const Vector2f moved = pixel_of(frame_.T_g_c.inverse() * on_surface);
    ASSERT_GT((moved - middle_).norm(), 10.f);
    const Picture after = present();
    EXPECT_LE(difference(color_at_view(after, moved), style::palette[0]), tolerance);
    const Picture before_it_came_back = after;
    frame_.T_g_c = RigidTransform::Identity();
    EXPECT_LE(difference(color_at_view(present(), middle_), style::palette[0]), tolerance);
    EXPECT_GT(differences(before_it_came_back, present()), 300);
}

TEST_F(PaintSceneTest, AStrokeGoesOnWhileTheCameraMoves) {
    press(tool::first_color);
    present({touch(70, TouchPhase::down, a_)});
    present({touch(70, TouchPhase::move, middle_)});
    const Vector3f start = back_project(frame_.intrinsics, a_.x(), a_.y(), table_m);
    frame_.T_g_c.translate(Vector3f(0.05f, 0.f, 0.f));
    TouchEvent event = touch(70, TouchPhase::up, {200.f, 150.f});
    event.tip.surface_c_m = back_project(frame_.intrinsics, 200.f, 150.f, table_m);
    present({event});
    const Picture after = present();
    EXPECT_LE(difference(color_at_view(after, pixel_of(frame_.T_g_c.inverse() * start)), style::palette[0]),
              tolerance);
    EXPECT_LE(difference(color_at_view(after, {199.f, 149.f}), style::palette[0]), tolerance);
}

TEST_F(PaintSceneTest, APaintingIsThereAgainAfterARestart) {
    open_with_file();
    stroke(a_, b_);
    pass(1.5f);
    ASSERT_TRUE(std::filesystem::exists(file_)) << "saved when nobody paints";
    const Picture painted = stroke({120.f, 90.f}, {180.f, 160.f});
    open_with_file();
    EXPECT_EQ(differences(present(), painted), 0) << "what was painted last, too";
}

TEST_F(PaintSceneTest, ARestartWithANewScanOfTheSameTableKeepsThePainting) {
    open_with_file();
    const Picture painted = stroke(a_, b_);
    presenter_.reset();
    frame_.T_g_c.translate(Vector3f(1.f, 2.f, 3.f));  // the new scan has another origin
    frame_.state = "scanning";
    open_with_file();
    frame_.state = "live";
    EXPECT_EQ(differences(present(), painted), 0);
}

TEST_F(PaintSceneTest, AfterUndoAndClearTheFileHasTheNewState) {
    open_with_file();
    const Picture empty = present();
    stroke(a_, b_);
    press(tool::clear, 1.f);
    pass(1.5f);
    open_with_file();
    EXPECT_EQ(differences(present(), empty), 0);
    press(tool::undo);
    EXPECT_GT(differences(present(), empty), 300) << "undo goes on over a restart";
}

TEST_F(PaintSceneTest, ADamagedFileGivesAnEmptyTable) {
    const Picture empty = present();
    for (const std::string& damaged : {std::string(), std::string("nonsense"), std::string(5000, '\xff')}) {
        std::ofstream(file_, std::ios::binary) << damaged;
        open_with_file();
        EXPECT_EQ(differences(present(), empty), 0);
    }
    const Picture painted = stroke(a_, b_);
    open_with_file();
    EXPECT_EQ(differences(present(), painted), 0) << "and it can be saved over";
}

TEST_F(PaintSceneTest, AFolderThatCannotBeWrittenHarmsNothing) {
    PresenterConfig config;
    config.scenes.painting_file = "/nonexistent/painting";
    open("paint", config);
    EXPECT_EQ(presenter_->operator_wish().unsaved, "");
    const Picture painted = stroke(a_, b_);
    pass(3.f);
    EXPECT_EQ(differences(present(), painted), 0);
    EXPECT_THAT(presenter_->operator_wish().unsaved, testing::HasSubstr("/nonexistent/painting"));
}

}  // namespace
}  // namespace touchstone
