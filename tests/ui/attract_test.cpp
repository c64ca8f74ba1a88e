// The table when nobody comes.
#include "ui/scenes/attract.hpp"

#include "scene_fixture.hpp"
#include "ui/canvas_renderer.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

class AttractTest : public SceneFixture {
  protected:
    /// Two seconds until it attracts.
    void open_idle(const std::string& scene) {
        PresenterConfig config;
        config.attract_after_s = 2.f;
        open(scene, config);
    }
    /// How much the mean of a block of 40 x 40 pixels has changed, of the one that changed most.
    static float most_changed_block(const Picture& a, const Picture& b) {
        constexpr int side = 40;
        float most = 0.f;
        for (int top = 0; top + side <= a.height_px; top += side)
            for (int left = 0; left + side <= a.width_px; left += side) {
                int sum = 0;
                for (int y = top; y < top + side; ++y)
                    for (int x = left; x < left + side; ++x) sum += color_at(a, x, y).g - color_at(b, x, y).g;
                most = std::max(most, std::abs(static_cast<float>(sum)) / (side * side));
            }
        return most;
    }
    bool attracts() { return color_at_view(present(), {2.f, 120.f}).r < 200; }  // the table is dimmed
};

TEST_F(AttractTest, ItBeginsWhenNobodyComesAndAHoverBringsTheSceneBack) {
    open_idle("paint");
    stroke({120.f, 120.f}, {200.f, 130.f});
    const style::Color paint = color_at_view(present(), {160.f, 125.f});
    pass(1.2f);
    EXPECT_FALSE(attracts());
    pass(4.f);
    EXPECT_TRUE(attracts());
    HoverEvent hover;
    hover.tip.pixel_px = {40.f, 200.f};
    for (int i = 0; i < 15; ++i) present({}, {hover});
    EXPECT_FALSE(attracts());
    EXPECT_LE(difference(color_at_view(present(), {160.f, 125.f}), paint), tolerance) << "what was painted";
    EXPECT_EQ(presenter_->scene_name(), "paint");
}

TEST_F(AttractTest, TheTouchThatWakesItPaintsNothing) {
    open_idle("paint");
    pass(5.f);
    stroke({120.f, 120.f}, {200.f, 130.f});
    EXPECT_EQ(color_at_view(present(), {160.f, 125.f}), style::white);
    stroke({120.f, 120.f}, {200.f, 130.f});
    EXPECT_NE(color_at_view(present(), {160.f, 125.f}), style::white);
}

TEST_F(AttractTest, NeverWithoutATime) {
    PresenterConfig config;
    config.attract_after_s = 0.f;
    open("paint", config);
    frame_.timestamp_us += 3'600'000'000;
    pass(0.5f);
    EXPECT_FALSE(attracts());
}

TEST_F(AttractTest, AScanIsNoIdleness) {
    open_idle("paint");
    frame_.state = "scanning";
    pass(3.f);
    frame_.state = "live";
    pass(1.5f);
    EXPECT_FALSE(attracts());
}

/// Rings travel, but no place of a finger's size becomes brighter or darker at a stroke.
TEST_F(AttractTest, NothingFlickers) {
    open("attract");
    Picture last = present();
    for (int i = 0; i < 150; ++i) {
        const Picture next = present();
        EXPECT_LT(most_changed_block(last, next), 12.f) << "of 255, frame " << i;
        last = next;
    }
}

/// Over a quarter of an hour no place is lit for more than a third of the time.
TEST_F(AttractTest, NothingBurnsIn) {
    AttractScene scene;
    scene.start(view_size);
    scene.show(frame_);
    Canvas canvas;
    CanvasRenderer renderer;
    const Layout layout = make_layout(display_size, view_size);
    constexpr int looks = 100;
    std::vector<int> lit(std::size_t{960} * 600, 0);
    for (int look = 0; look < looks; ++look) {
        for (int i = 0; i < 37; ++i) scene.update(0.25f);
        display_->begin_frame();
        glClearColor(0.f, 0.f, 0.f, 1.f);
        glClear(GL_COLOR_BUFFER_BIT);
        canvas.begin({960.f, 600.f}, layout.scale);
        scene.draw(canvas, layout.view, 1.f);
        renderer.draw(canvas);
        const Picture shown = display_->read_pixels();
        for (std::size_t i = 0; i < lit.size(); ++i) lit[i] += shown.rgba[4 * i + 1] > 60 ? 1 : 0;
    }
    EXPECT_GT(std::count_if(lit.begin(), lit.end(), [](int n) { return n > 0; }), 50'000)
        << "it is everywhere";
    EXPECT_LT(*std::max_element(lit.begin(), lit.end()), looks / 3);
}

TEST_F(AttractTest, ATouchMakesARing) {
    PresenterConfig config;
    config.menu = false;
    open("attract", config);
    tap({60.f, 60.f});
    pass(1.0f);
    const Picture shown = present();
    int coloured = 0;
    for (float x = 62.f; x < 110.f; x += 0.5f) {
        const style::Color color = color_at_view(shown, {x, 60.f});
        coloured +=
            std::max({color.r, color.g, color.b}) - std::min({color.r, color.g, color.b}) > 60 ? 1 : 0;
    }
    EXPECT_GT(coloured, 2);
}

}  // namespace
}  // namespace touchstone
