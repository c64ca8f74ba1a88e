#include "ui/table_presenter.hpp"

#include <GLES3/gl31.h>
#include <functional>
#include <gtest/gtest.h>

#include "picture_probe.hpp"
#include "platform/display/gl_error.hpp"
#include "platform/display/headless_display.hpp"
#include "ui/layout.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

constexpr PixelSize display_size{800, 480};
constexpr PixelSize view_size{320, 240};
constexpr int tolerance = 3;  // of 255: rounding in filters and blending

/// White, and foreground (alpha 0) where the predicate says so: on white, paint has exactly its palette
/// colour.
std::shared_ptr<const ShadedView> make_view(const std::function<bool(int, int)>& is_foreground) {
    auto view = std::make_shared<ShadedView>();
    *view = {view_size.width_px, view_size.height_px, {}};
    for (int y = 0; y < view_size.height_px; ++y)
        for (int x = 0; x < view_size.width_px; ++x) {
            const std::uint8_t alpha = is_foreground(x, y) ? 0 : 255;
            view->rgba.insert(view->rgba.end(), {255, 255, 255, alpha});
        }
    return view;
}

TouchEvent touch(int id, TouchPhase phase, Vector2f pixel_px) {
    TouchEvent event;
    event.tip.id = id;
    event.tip.pixel_px = pixel_px;
    event.phase = phase;
    return event;
}

float distance_to_line(Vector2f p, Vector2f a, Vector2f b) {
    const float t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.f, 1.f);
    return (p - a - t * (b - a)).norm();
}

int count_gl_objects() {
    int count = 0;
    for (GLuint id = 1; id < 2000; ++id)
        for (const auto is_object :
             {glIsTexture, glIsBuffer, glIsFramebuffer, glIsVertexArray, glIsProgram, glIsShader})
            count += is_object(id) ? 1 : 0;
    return count;
}

class TablePresenterTest : public testing::Test {
  protected:
    TablePresenterTest() {
        frame_.state = "live";
        frame_.frame_rate_hz = 30.f;
        frame_.view = make_view([](int, int) { return false; });
    }

    Picture present(std::vector<TouchEvent> touches = {}, std::vector<HoverEvent> hovers = {}) {
        ++frame_.index;
        frame_.touches = std::move(touches);
        frame_.hovers = std::move(hovers);
        presenter_.present(frame_, 1.f / 30.f);
        EXPECT_EQ(take_gl_errors(), "");
        return display_->read_pixels();
    }

    /// Down at a, along to b, up there.
    Picture draw_stroke(int id, Vector2f a, Vector2f b) {
        present({touch(id, TouchPhase::down, a)});
        for (int i = 1; i <= 5; ++i)
            present({touch(id, TouchPhase::move, a + 0.2f * static_cast<float>(i) * (b - a))});
        return present({touch(id, TouchPhase::up, b)});
    }

    style::Color color_at_view(const Picture& picture, Vector2f pixel_px) const {
        const Vector2f at = mapping_.to_display(pixel_px);
        return color_at(picture, static_cast<int>(at.x()), static_cast<int>(at.y()));
    }

    const ViewMapping mapping_ = make_layout(display_size, view_size).view;
    /// Of the depth picture, whose width is taken to be 1088 mm while a frame does not tell.
    const float stroke_radius_px_ = 0.5f * style::stroke_widths_mm[1] / 1088.f * view_size.width_px;
    std::unique_ptr<Display> display_ = make_headless_display(display_size);
    TablePresenter presenter_{*display_, "paint"};
    TableFrame frame_;
};

TEST_F(TablePresenterTest, StrokeHasThePaletteColourAlongItsLineAndNowhereElse) {
    const Picture before = present();
    const Vector2f a(60.f, 80.f);
    const Vector2f b(250.f, 150.f);
    const Picture after = draw_stroke(1, a, b);
    for (int i = 0; i <= 20; ++i) {
        const Vector2f place = a + 0.05f * static_cast<float>(i) * (b - a);
        EXPECT_LE(difference(color_at_view(after, place), style::finger_color(1)), tolerance) << i;
    }
    int strays = 0;
    for_each_difference(before, after, tolerance, [&](int x, int y) {
        const Vector2f place = mapping_.to_view({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
        const bool is_in_tools = place.y() > 200.f;  // undo can be touched now
        if (!is_in_tools && distance_to_line(place, a, b) > stroke_radius_px_ + 1.f) ++strays;
    });
    EXPECT_EQ(strays, 0);
}

TEST_F(TablePresenterTest, PaintIsDarkerOnADarkerSurface) {
    auto dark = std::make_shared<ShadedView>(*frame_.view);
    for (std::size_t i = 0; i < dark->rgba.size(); ++i)
        if (i % 4 != 3) dark->rgba[i] = 40;
    draw_stroke(1, {60.f, 80.f}, {250.f, 80.f});
    frame_.view = dark;
    const style::Color paint = color_at_view(present(), {150.f, 80.f});
    EXPECT_LT(paint.r, 0.8f * style::finger_color(1).r);
    EXPECT_GT(difference(paint, {40, 40, 40}), 30) << "still coloured";
}

TEST_F(TablePresenterTest, StrokeGoesUnderTheForeground) {
    draw_stroke(2, {40.f, 100.f}, {280.f, 100.f});
    frame_.view = make_view([](int x, int) { return x >= 100 && x < 200; });
    const Picture hand_over_it = present();
    EXPECT_EQ(color_at_view(hand_over_it, {150.f, 100.f}), style::white);
    EXPECT_LE(difference(color_at_view(hand_over_it, {60.f, 100.f}), style::finger_color(2)), tolerance);
    EXPECT_LE(difference(color_at_view(hand_over_it, {240.f, 100.f}), style::finger_color(2)), tolerance);
}

TEST_F(TablePresenterTest, TapLeavesADot) {
    const Vector2f place(100.f, 60.f);
    const Picture after = present({touch(4, TouchPhase::down, place), touch(4, TouchPhase::up, place)});
    EXPECT_LE(difference(color_at_view(after, place), style::finger_color(4)), tolerance);
    EXPECT_EQ(color_at_view(after, place + Vector2f(3.f * stroke_radius_px_, 0.f)), style::white);
}

TEST_F(TablePresenterTest, UpEndsTheStroke) {
    draw_stroke(1, {40.f, 50.f}, {100.f, 50.f});
    const Picture after = draw_stroke(1, {200.f, 50.f}, {260.f, 50.f});
    EXPECT_EQ(color_at_view(after, {150.f, 50.f}), style::white)
        << "no paint between two strokes of one finger";
    EXPECT_LE(difference(color_at_view(after, {230.f, 50.f}), style::finger_color(1)), tolerance);
}

TEST_F(TablePresenterTest, AFingerSeenFirstInMotionStartsThere) {
    draw_stroke(1, {40.f, 50.f}, {100.f, 50.f});
    const Picture after =
        present({touch(1, TouchPhase::move, {200.f, 50.f}), touch(1, TouchPhase::move, {260.f, 50.f}),
                 touch(1, TouchPhase::up, {260.f, 50.f})});
    EXPECT_EQ(color_at_view(after, {150.f, 50.f}), style::white) << "no paint from its last stroke to here";
    EXPECT_LE(difference(color_at_view(after, {230.f, 50.f}), style::finger_color(1)), tolerance);
}

TEST_F(TablePresenterTest, FingersAtTheSameTimeHaveStrokesOfTheirOwn) {
    for (int i = 0; i <= 5; ++i) {
        const TouchPhase phase = i == 0 ? TouchPhase::down : i == 5 ? TouchPhase::up : TouchPhase::move;
        const float x = 60.f + 30.f * static_cast<float>(i);
        present({touch(1, phase, {x, 60.f}), touch(2, phase, {x, 160.f})});
    }
    const Picture after = present();
    EXPECT_LE(difference(color_at_view(after, {130.f, 60.f}), style::finger_color(1)), tolerance);
    EXPECT_LE(difference(color_at_view(after, {130.f, 160.f}), style::finger_color(2)), tolerance);
    EXPECT_NE(style::finger_color(1), style::finger_color(2));
    EXPECT_EQ(color_at_view(after, {130.f, 110.f}), style::white);
}

TEST_F(TablePresenterTest, EventsOfUndrawnFramesMakeTheSameStroke) {
    std::vector<TouchEvent> events{touch(1, TouchPhase::down, {60.f, 60.f})};
    for (int i = 1; i <= 10; ++i)
        events.push_back(touch(1, TouchPhase::move, {60.f + 15.f * static_cast<float>(i), 60.f}));
    events.push_back(touch(1, TouchPhase::up, {220.f, 60.f}));
    const Picture after = present(events);
    for (float x = 60.f; x <= 220.f; x += 10.f)
        EXPECT_LE(difference(color_at_view(after, {x, 60.f}), style::finger_color(1)), tolerance) << x;
}

TEST_F(TablePresenterTest, TouchIsADiscAndHoverARing) {
    const Picture before = present();
    const Vector2f place(160.f, 120.f);
    HoverEvent hover;
    hover.tip = touch(3, TouchPhase::move, place).tip;
    const Picture hovering = present({}, {hover});
    const float radius_view_px =
        style::hover_radius_px * make_layout(display_size, view_size).scale / mapping_.display_px_per_px;
    int nearest = 255;  // of the pixels across the ring, two pixels wide here
    for (float off_px = -1.5f; off_px <= 1.5f; off_px += 0.5f) {
        const Vector2f across(radius_view_px + off_px / mapping_.display_px_per_px, 0.f);
        nearest =
            std::min(nearest, difference(color_at_view(hovering, place + across), style::finger_color(3)));
    }
    EXPECT_LE(nearest, 25) << "of 255: the ring covers no pixel wholly";
    EXPECT_EQ(color_at_view(hovering, place + Vector2f(0.5f * radius_view_px, 0.f)), style::white);
    EXPECT_EQ(count_differences(before, present(), 0), 0) << "the ring is gone with its finger";

    const Picture touching = present({touch(3, TouchPhase::down, place)});
    EXPECT_LE(difference(color_at_view(touching, place), style::finger_color(3)), tolerance);
    EXPECT_LE(difference(color_at_view(touching, place + Vector2f(0.f, 0.5f * radius_view_px)),
                         style::finger_color(3)),
              tolerance);
}

TEST_F(TablePresenterTest, HigherFingersHaveWiderRings) {
    const Picture before = present();
    HoverEvent hover;
    hover.tip = touch(3, TouchPhase::move, {160.f, 120.f}).tip;
    hover.tip.height_m = 0.002f;
    const int near = count_differences(before, present({}, {hover}), tolerance);
    hover.tip.height_m = 0.05f;
    EXPECT_GT(count_differences(before, present({}, {hover}), tolerance), near);
}

TEST_F(TablePresenterTest, AFrameShownTwiceIsTakenInOnce) {
    frame_.touches = {touch(1, TouchPhase::down, {50.f, 50.f}), touch(1, TouchPhase::move, {50.f, 150.f}),
                      touch(1, TouchPhase::move, {200.f, 150.f})};
    ++frame_.index;
    presenter_.present(frame_, 0.03f);
    const Picture once = display_->read_pixels();
    presenter_.present(frame_, 0.03f);
    EXPECT_EQ(count_differences(once, display_->read_pixels(), 0), 0);
}

TEST_F(TablePresenterTest, LosingTheSensorLiftsFingersAndKeepsPaint) {
    const Vector2f place(100.f, 100.f);
    draw_stroke(1, {40.f, 40.f}, {250.f, 40.f});
    present({touch(2, TouchPhase::down, place)});
    frame_.state = "sensor_lost";
    present();
    frame_.state = "live";
    const float disc_px = style::touch_radius_px * make_layout(display_size, view_size).scale;
    const Vector2f in_disc(0.f, 0.8f * disc_px / mapping_.display_px_per_px);
    EXPECT_EQ(color_at_view(present(), place + in_disc), style::white)
        << "no disc of a finger nobody saw leave";
    const Picture after =
        present({touch(2, TouchPhase::move, {250.f, 200.f}), touch(2, TouchPhase::up, {250.f, 200.f})});
    EXPECT_LE(difference(color_at_view(after, {150.f, 40.f}), style::finger_color(1)), tolerance);
    EXPECT_EQ(color_at_view(after, {175.f, 150.f}), style::white) << "no line from the place before the loss";
}

TEST_F(TablePresenterTest, ANewScanTakesThePaintAway) {
    const Picture before = present();
    draw_stroke(1, {40.f, 40.f}, {250.f, 40.f});
    frame_.state = "scanning";
    present();
    frame_.state = "live";
    EXPECT_EQ(count_differences(before, present(), 0), 0);
}

TEST_F(TablePresenterTest, ScanProgressGrows) {
    frame_.state = "scanning";
    frame_.scan_progress = 0.2f;
    const Picture fifth = present();
    frame_.scan_progress = 0.8f;
    const Picture most = present();
    EXPECT_GT(count_differences(fifth, most, 40), 100);
    EXPECT_GT(count_differences(fifth, present(), 40), 100);
}

TEST_F(TablePresenterTest, ShowsSomethingBeforeTheFirstView) {
    frame_.state = "starting";
    frame_.view = nullptr;
    const Picture starting = present();
    int bright = 0;
    for (std::size_t i = 0; i < starting.rgba.size(); i += 4) bright += starting.rgba[i] > 150 ? 1 : 0;
    EXPECT_GT(bright, 500) << "pixels of letters";
}

TEST_F(TablePresenterTest, TheInteractiveAreaIsOutlined) {
    auto gray = std::make_shared<ShadedView>(*frame_.view);
    std::fill(gray->rgba.begin(), gray->rgba.end(), std::uint8_t{100});
    frame_.view = gray;
    frame_.has_area = true;
    frame_.area_px = {Vector2f(50.f, 50.f), Vector2f(270.f, 50.f), Vector2f(270.f, 190.f),
                      Vector2f(50.f, 190.f)};
    const Picture outlined = present();
    EXPECT_GT(color_at_view(outlined, {50.f, 120.f}).r, 120);
    EXPECT_GT(color_at_view(outlined, {160.f, 190.f}).r, 120);
    EXPECT_EQ(color_at_view(outlined, {160.f, 120.f}).r, 100);
}

/// A finger that touches it is marked, but paints nothing.
TEST_F(TablePresenterTest, ACrossIsShownWhileTouchesAreCalibrated) {
    const Vector2f place(120.f, 90.f), beside = place + Vector2f(7.f, 7.f);
    const Picture before = present();
    frame_.cross = CrossGuide{place, 2, 15, "Touch the cross"};
    const Picture asking = present();
    const auto changed = [&](const Vector2f& at) {
        return difference(color_at_view(asking, at), color_at_view(before, at)) > tolerance;
    };
    const float ring_view_px = 22.f * make_layout(display_size, view_size).scale / mapping_.display_px_per_px;
    EXPECT_TRUE(changed(place + Vector2f(ring_view_px, 0.f)));
    EXPECT_FALSE(changed(place + Vector2f(3.f * ring_view_px, 0.f)));
    EXPECT_GT(count_differences(before, asking, tolerance), 500) << "and words say what to do";
    draw_stroke(1, place, {280.f, 90.f});
    frame_.cross.reset();
    EXPECT_EQ(color_at_view(present(), {200.f, 90.f}), style::white);
    EXPECT_EQ(color_at_view(present(), beside), style::white);
}

TEST_F(TablePresenterTest, ThreeHundredFramesLeaveNoObjectsBehind) {
    const std::array views{make_view([](int, int) { return false; }),
                           make_view([](int x, int) { return x < 50; })};
    draw_stroke(1, {40.f, 40.f}, {250.f, 40.f});
    const int at_first = count_gl_objects();
    EXPECT_GT(at_first, 5);
    for (int i = 0; i < 300; ++i) {
        frame_.view = views[static_cast<std::size_t>(i) % 2];
        const float x = 20.f + static_cast<float>(i % 250);
        ++frame_.index;
        frame_.touches = {touch(i / 50, i % 50 == 0 ? TouchPhase::down : TouchPhase::move, {x, 100.f})};
        presenter_.present(frame_, 1.f / 30.f);
        ASSERT_EQ(take_gl_errors(), "") << "frame " << i;
    }
    EXPECT_EQ(count_gl_objects(), at_first);
}

}  // namespace
}  // namespace touchstone
