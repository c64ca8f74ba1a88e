#include "ui/canvas.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "picture_probe.hpp"
#include "platform/display/gl_error.hpp"
#include "platform/display/headless_display.hpp"
#include "platform/system/error.hpp"
#include "ui/canvas_renderer.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

constexpr PixelSize size{400, 200};

class CanvasTest : public testing::Test {
  protected:
    Picture show() {
        display_->begin_frame();
        glClearColor(0.f, 0.f, 0.f, 1.f);
        glClear(GL_COLOR_BUFFER_BIT);
        renderer_.draw(canvas_);
        EXPECT_EQ(take_gl_errors(), "");
        return display_->read_pixels();
    }
    void begin(float scale = 1.f) { canvas_.begin({size.width_px, size.height_px}, scale); }

    std::unique_ptr<Display> display_ = make_headless_display(size);
    Canvas canvas_;
    CanvasRenderer renderer_;
};

TEST_F(CanvasTest, TextIsDrawnInItsBoxAndNowhereElse) {
    begin();
    const Picture empty = show();
    begin();
    const Vector2f at(50.f, 60.f);
    canvas_.text(TextStyle::heading, at, style::white, "Live \u00b7 30 frames / s");
    const Vector2f box = canvas_.text_size_px(TextStyle::heading, "Live \u00b7 30 frames / s");
    const Picture shown = show();
    int inside = 0;
    int outside = 0;
    for_each_difference(empty, shown, 40, [&](int x, int y) {
        const Vector2f from_corner = Vector2f(static_cast<float>(x), static_cast<float>(y)) - at;
        const bool in_box =
            (from_corner.array() >= -1.f).all() && (from_corner.array() <= box.array() + 1.f).all();
        ++(in_box ? inside : outside);
    });
    EXPECT_GT(inside, 300) << "pixels of letters";
    EXPECT_LT(inside, static_cast<int>(0.6f * box.x() * box.y())) << "letters, not a filled box";
    EXPECT_EQ(outside, 0);
}

TEST_F(CanvasTest, EveryStyleHasLettersOfItsOwnSizeAtEachScale) {
    for (const float scale : {1.f, 1.5f}) {
        begin(scale);
        const float caption = canvas_.text_size_px(TextStyle::caption, "T").y();
        const float figure = canvas_.text_size_px(TextStyle::figure, "T").y();
        EXPECT_NEAR(caption, style::caption_px * scale, 0.51f);
        EXPECT_NEAR(figure, style::figure_px * scale, 0.51f);
    }
}

TEST_F(CanvasTest, LongTextIsWrapped) {
    begin();
    const Vector2f one_line = canvas_.text_size_px(TextStyle::body, "one two three four");
    const Vector2f wrapped = canvas_.text_size_px(TextStyle::body, "one two three four", 0.6f * one_line.x());
    EXPECT_LE(wrapped.x(), 0.6f * one_line.x() + 1.f);
    EXPECT_NEAR(wrapped.y(), 2.f * one_line.y(), 0.1f);
}

TEST_F(CanvasTest, ShapesLieWhereTheyAreAskedFor) {
    begin();
    canvas_.disc({100.f, 50.f}, 20.f, style::good);
    canvas_.ring({250.f, 100.f}, 40.f, 6.f, style::bad);
    canvas_.arc({350.f, 150.f}, 30.f, 6.f, 0.f, 0.25f, style::accent);
    const Picture shown = show();
    EXPECT_EQ(color_at(shown, 100, 50), style::good);
    EXPECT_EQ(color_at(shown, 100, 67), style::good);
    EXPECT_EQ(color_at(shown, 100, 72), (style::Color{0, 0, 0}));
    EXPECT_EQ(color_at(shown, 290, 100), style::bad);
    EXPECT_EQ(color_at(shown, 250, 100), (style::Color{0, 0, 0}));
    EXPECT_EQ(color_at(shown, 371, 129), style::accent) << "an eighth of a turn from the top, clockwise";
    EXPECT_EQ(color_at(shown, 329, 129), (style::Color{0, 0, 0}));
}

TEST(Fonts, TakesTheFirstFileThatExists) {
    FontFiles files = default_font_files();
    files.regular.insert(files.regular.begin(), "/nonexistent/a.otf");
    EXPECT_NO_THROW(Fonts(files, 1.f));
}

TEST(Fonts, MissingFontNamesFileAndPackage) {
    try {
        const Fonts fonts({{"/nonexistent/a.otf"}, {"/nonexistent/b.otf"}}, 1.f);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::unavailable);
        EXPECT_THAT(error.what(), testing::HasSubstr("/nonexistent/a.otf"));
        EXPECT_THAT(error.what(), testing::HasSubstr("fonts-inter"));
    }
}

}  // namespace
}  // namespace touchstone
