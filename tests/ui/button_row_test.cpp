#include "ui/button_row.hpp"

#include <gtest/gtest.h>

#include "ui/layout.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

constexpr PixelSize view_size{640, 480};

class ButtonRowTest : public testing::Test {
  protected:
    ButtonRowTest() { canvas_.begin({1280.f, 720.f}, layout_.scale); }

    void lay_out(int count, float camera_m, bool held = false) {
        TableFrame frame;
        frame.intrinsics = {575.f, 575.f, 319.5f, 239.5f, 640, 480, {0, 0}};
        frame.has_area = true;
        frame.area = {{-0.3f, -0.25f, camera_m}, {0.6f, 0.f, 0.f}, {0.f, 0.5f, 0.f}};
        const Vector2f low(319.5f - 0.3f * 575.f / camera_m, 239.5f - 0.25f * 575.f / camera_m);
        const Vector2f high = Vector2f(639.f, 479.f) - low;
        frame.area_px = {low, Vector2f(high.x(), low.y()), high, Vector2f(low.x(), high.y())};
        surface_ = SurfaceGeometry(frame, view_size);
        std::vector<Button> buttons(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) {
            buttons[static_cast<std::size_t>(i)].id = i;
            buttons[static_cast<std::size_t>(i)].is_held = held;
        }
        row_.set(buttons);
        row_.lay_out(canvas_, layout_.view, surface_);
    }

    TouchEvent touch(int id, TouchPhase phase, Vector2f place_px) const {
        TouchEvent event;
        event.tip.id = id;
        event.tip.pixel_px = place_px;
        event.phase = phase;
        return event;
    }

    const Layout layout_ = make_layout({1280, 720}, view_size);
    Canvas canvas_;
    SurfaceGeometry surface_;
    ButtonRow row_{RowEdge::bottom};
};

TEST_F(ButtonRowTest, ButtonsAreNeverSmallerThanSixteenMillimetres) {
    for (const int count : {1, 6, 16, 30})
        for (const float camera_m : {0.6f, 1.1f, 2.5f}) {
            lay_out(count, camera_m);
            for (int i = 0; i < count; ++i) {
                const Eigen::AlignedBox2f place = row_.place_px(i);
                const float mm = place.sizes().minCoeff() * surface_.mm_per_px(place.center());
                EXPECT_GE(mm, least_button_mm - 0.01f) << count << " buttons, " << camera_m << " m";
            }
        }
}

TEST_F(ButtonRowTest, ButtonsDoNotOverlapAndLieInTheArea) {
    lay_out(15, 1.1f);
    for (int i = 0; i < 15; ++i) {
        EXPECT_TRUE(surface_.room().box_px().contains(row_.place_px(i))) << i;
        if (i == 0) continue;
        EXPECT_GT(row_.place_px(i).min().x(), row_.place_px(i - 1).max().x());
    }
}

TEST_F(ButtonRowTest, AFingerThatComesDownPressesOnceAndIsTheRows) {
    lay_out(3, 1.1f);
    const Vector2f place = row_.place_px(1).center();
    EXPECT_TRUE(row_.on_touch(touch(5, TouchPhase::down, place)));
    EXPECT_EQ(row_.update(33'000), std::vector{1});
    EXPECT_TRUE(row_.on_touch(touch(5, TouchPhase::move, {10.f, 10.f}))) << "wherever it goes";
    EXPECT_TRUE(row_.on_touch(touch(5, TouchPhase::up, {10.f, 10.f})));
    EXPECT_TRUE(row_.update(66'000).empty());
    EXPECT_FALSE(row_.on_touch(touch(5, TouchPhase::move, place))) << "it has gone up";
}

TEST_F(ButtonRowTest, AFingerThatComesFromElsewhereIsNotTheRows) {
    lay_out(3, 1.1f);
    EXPECT_FALSE(row_.on_touch(touch(5, TouchPhase::down, {320.f, 200.f})));
    EXPECT_FALSE(row_.on_touch(touch(5, TouchPhase::move, row_.place_px(1).center())));
    EXPECT_TRUE(row_.update(33'000).empty());
}

TEST_F(ButtonRowTest, ATouchThatDropsOutIsNoSecondPress) {
    lay_out(3, 1.1f);
    const Vector2f place = row_.place_px(2).center();
    row_.update(100'000);
    row_.on_touch(touch(1, TouchPhase::down, place));
    row_.on_touch(touch(1, TouchPhase::up, place));
    EXPECT_EQ(row_.update(166'000), std::vector{2});
    row_.on_touch(touch(2, TouchPhase::down, place));
    row_.on_touch(touch(2, TouchPhase::up, place));
    EXPECT_TRUE(row_.update(400'000).empty());
    row_.on_touch(touch(3, TouchPhase::down, place));
    EXPECT_EQ(row_.update(433'000), std::vector{2});
}

TEST_F(ButtonRowTest, AHeldButtonIsPressedAfterItsTimeAndOnlyThen) {
    lay_out(3, 1.1f, true);
    const Vector2f place = row_.place_px(0).center();
    row_.update(1'000'000);
    row_.on_touch(touch(1, TouchPhase::down, place));
    EXPECT_TRUE(row_.update(1'000'000 + button_hold_us - 1).empty());
    EXPECT_EQ(row_.update(1'000'000 + button_hold_us), std::vector{0});
    EXPECT_TRUE(row_.update(9'000'000).empty()) << "once";
    row_.on_touch(touch(1, TouchPhase::up, place));
    row_.on_touch(touch(2, TouchPhase::down, place));
    row_.on_touch(touch(2, TouchPhase::up, place));
    EXPECT_TRUE(row_.update(20'000'000).empty()) << "let go too soon";
}

TEST_F(ButtonRowTest, ADisabledButtonDoesNothingButKeepsTheFinger) {
    lay_out(2, 1.1f);
    std::vector<Button> buttons = row_.buttons();
    buttons[0].enabled = false;
    row_.set(buttons);
    EXPECT_TRUE(row_.on_touch(touch(1, TouchPhase::down, row_.place_px(0).center())));
    EXPECT_TRUE(row_.update(33'000).empty());
}

}  // namespace
}  // namespace touchstone
