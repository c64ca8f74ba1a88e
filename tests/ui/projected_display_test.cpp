#include "ui/projected_display.hpp"

#include <algorithm>

#include "projection_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float tolerance_mm = 2.f, touch_tolerance_mm = 1.5f;

/// A thing drawn from above, and how far outside of it a place is (millimetres, negative inside).
struct Drawing {
    std::function<void(Canvas&)> draw;
    std::function<float(const Vector2f& place_mm)> outside_mm;
};

/// Canvas places have their origin at the picture's upper left corner: at 1 px per mm, millimetres.
Drawing line(const Vector2f& a, const Vector2f& b, float width) {
    return {[=](Canvas& canvas) { canvas.line(a, b, width, style::white); },
            [=](const Vector2f& p) {
                const Vector2f along = (b - a).normalized(), from_middle = p - 0.5f * (a + b);
                const float beyond_end = std::abs(along.dot(from_middle)) - 0.5f * (b - a).norm();
                const float beside = std::abs(along.x() * from_middle.y() - along.y() * from_middle.x());
                return std::max(beyond_end, beside - 0.5f * width);
            }};
}

Drawing disc(const Vector2f& center, float radius) {
    return {[=](Canvas& canvas) { canvas.disc(center, radius, style::white); },
            [=](const Vector2f& p) { return (p - center).norm() - radius; }};
}

class ProjectedDisplayTest : public ProjectionFixture {
  protected:
    /// How far the edge of what is seen on the surface is from the edge of what was drawn.
    float worst_mm(const Height& height, const Drawing& drawing) {
        const Picture thrown = project_drawing(drawing.draw);
        float worst = 0.f;
        int lit = 0;
        for_each_lit_place(height, thrown, [&](int x, int y, const Vector2f& place_mm) {
            const bool is_here = is_lit(thrown, x, y);
            const float outside = drawing.outside_mm(place_mm);
            worst = std::max(worst, is_here ? outside : -outside);
            lit += is_here ? 1 : 0;
        });
        EXPECT_GT(lit, 100);
        return worst;
    }

    void expect_in_place(const Height& height, const std::string& name) {
        const Drawing flat_line = line({20.f, 370.f}, {580.f, 60.f}, 10.f);
        const Drawing steep_line = line({250.f, 20.f}, {330.f, 380.f}, 10.f);
        const Drawing round = disc({320.f, 190.f}, 80.f);
        for (const auto& [what, drawing] :
             {std::pair{"line", flat_line}, std::pair{"steep line", steep_line}, std::pair{"disc", round}}) {
            const float worst = worst_mm(height, drawing);
            EXPECT_LT(worst, tolerance_mm) << what << " on " << name;
            RecordProperty(name + " " + what, std::to_string(worst));
        }
    }

    ViewFromAbove view() const { return make_view_from_above(frame_.area, frame_.T_g_c); }
};

TEST_F(ProjectedDisplayTest, LinesAreStraightAndDiscsRoundOnARidge) {
    display_.set_mapping(model_, view(), grid_of(ridge).get());
    expect_in_place(ridge, "ridge");
}

TEST_F(ProjectedDisplayTest, AndInABowl) {
    display_.set_mapping(model_, view(), grid_of(bowl).get());
    expect_in_place(bowl, "bowl");
}

TEST_F(ProjectedDisplayTest, AndOnAFlatTableWhoseSurfaceIsNotTold) {
    display_.set_mapping(model_, view(), nullptr);
    expect_in_place(flat, "flat");
}

TEST_F(ProjectedDisplayTest, AndOnThePlaneOfAHomography) {
    const ProjectorModel plane = homography();
    display_.set_mapping(plane, view(), grid_of(ridge).get());
    expect_in_place(flat, "homography");
}

TEST_F(ProjectedDisplayTest, AModelOfAnotherSizeIsScaledToTheDisplay) {
    model_.width_px = 1024;
    model_.height_px = 768;
    model_.focal_px = {1200.f, 1450.f};
    model_.center_px = {520.f, 403.f};
    display_.set_mapping(model_, view(), grid_of(ridge).get());
    expect_in_place(ridge, "scaled");
}

/// A plane where there is a ridge: the test sees what it looks for.
TEST_F(ProjectedDisplayTest, AWrongSurfaceIsNoticed) {
    display_.set_mapping(model_, view(), grid_of(flat).get());
    EXPECT_GT(worst_mm(ridge, disc({320.f, 190.f}, 80.f)), 5.f);
}

TEST_F(ProjectedDisplayTest, ATouchIsLitWhereItIs) {
    const ViewFromAbove from_above = view();
    const auto grid = grid_of(ridge);
    display_.set_mapping(model_, from_above, grid.get());
    for (const Vector2f& at_t_m : {Vector2f(0.02f, 0.01f), Vector2f(-0.05f, 0.05f), Vector2f(0.1f, -0.12f)}) {
        const Vector3f touched_t_m(at_t_m.x(), at_t_m.y(), -ridge(at_t_m.x(), at_t_m.y()));
        TouchEvent touch;
        touch.tip.surface_c_m = frame_.T_g_c.inverse() * (T_g_t_ * touched_t_m);
        frame_.touches = {touch};
        const Vector2f pixel_px = seen_from_above(frame_, from_above).touches.at(0).tip.pixel_px;
        const Picture thrown = project_drawing(
            [&](Canvas& canvas) { canvas.disc(pixel_px + Vector2f(0.5f, 0.5f), 6.f, style::white); });
        Vector2f sum_mm(0.f, 0.f);
        int lit = 0;
        for_each_lit_place(ridge, thrown, [&](int x, int y, const Vector2f& place_mm) {
            if (!is_lit(thrown, x, y)) return;
            sum_mm += place_mm;
            ++lit;
        });
        ASSERT_GT(lit, 5);
        const float off_mm = (sum_mm / static_cast<float>(lit) - place_mm(touched_t_m)).norm();
        EXPECT_LT(off_mm, touch_tolerance_mm) << at_t_m.transpose();
        RecordProperty("touch at " + std::to_string(at_t_m.x()), std::to_string(off_mm));
    }
}

TEST_F(ProjectedDisplayTest, NothingIsLitBesideTheView) {
    display_.set_mapping(model_, view(), grid_of(bowl).get());
    const Picture thrown = project_drawing([](Canvas& canvas) {
        canvas.box({-9.f, -9.f}, {999.f, 999.f}, 0.f, style::white);
    });
    int strays = 0, dark = 0;
    for_each_lit_place(bowl, thrown, [&](int x, int y, const Vector2f& place_mm) {
        const Vector2f from_middle = (place_mm - Vector2f(300.f, 200.f)).cwiseAbs() - Vector2f(300.f, 200.f);
        if (is_lit(thrown, x, y) && from_middle.maxCoeff() > tolerance_mm) ++strays;
        if (!is_lit(thrown, x, y) && from_middle.maxCoeff() < -tolerance_mm) ++dark;
    });
    EXPECT_EQ(strays, 0);
    EXPECT_EQ(dark, 0);
}

TEST_F(ProjectedDisplayTest, ThereIsNoLightOnAHand) {
    const auto is_hand = [](int x, int y) { return std::hypot(x - 330, y - 200) < 60; };
    see(is_hand);
    display_.set_mapping(model_, view(), grid_of(ridge).get());
    const auto white = [](Canvas& canvas) { canvas.box({-9.f, -9.f}, {999.f, 999.f}, 0.f, style::white); };
    const auto count = [&](const Picture& thrown) {
        std::array<int, 2> lit_dark{0, 0};  // of what the camera sees hands at, and of the rest
        const RigidTransform T_c_t = frame_.T_g_c.inverse() * T_g_t_;
        for_each_lit_place(ridge, thrown, [&](int x, int y, const Vector2f& place_mm) {
            const Vector2f t = 0.001f * place_mm - Vector2f(0.5f * width_m, 0.5f * height_m);
            const Vector2f seen =
                touchstone::project(frame_.intrinsics, T_c_t * Vector3f(t.x(), t.y(), -ridge(t.x(), t.y())));
            const float from_hand_px = std::hypot(seen.x() - 330.f, seen.y() - 200.f) - 60.f;
            const bool inside = (t.cwiseAbs() - Vector2f(0.295f, 0.195f)).maxCoeff() < 0.f;
            if (from_hand_px < -2.f && color_at(thrown, x, y).g > 0) ++lit_dark[0];
            if (from_hand_px > 2.f && inside && !is_lit(thrown, x, y)) ++lit_dark[1];
        });
        return lit_dark;
    };
    display_.see_hands(frame_);
    EXPECT_EQ(count(project_drawing(white)), (std::array{0, 0}));
    see([](int, int) { return false; });
    display_.see_hands(frame_);
    EXPECT_GT(count(project_drawing(white))[0], 500) << "the hand is gone";
}

TEST_F(ProjectedDisplayTest, HandsAreLitWhereThatIsWished) {
    see([](int, int) { return true; });
    ProjectedDisplay display(*projector_, {.spare_hands = false});
    display.set_mapping(model_, view(), grid_of(ridge).get());
    display.see_hands(frame_);
    display.begin_frame();
    glClearColor(1.f, 1.f, 1.f, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
    display.present();
    const Picture thrown = display.read_pixels();
    int lit = 0;
    for (std::size_t i = 0; i < thrown.rgba.size(); i += 4) lit += thrown.rgba[i] > 200 ? 1 : 0;
    EXPECT_GT(lit, 100'000);
}

/// The line lies in the shadow of a step, and is not thrown onto the step.
TEST_F(ProjectedDisplayTest, TheNearerSurfaceIsLit) {
    const Height step = [](float x_m, float) { return x_m < 0.f ? 0.08f : 0.f; };
    model_.T_p_g = (T_g_t_ * looking_at_table({-0.5f, -0.35f, -1.2f})).inverse();
    display_.set_mapping(model_, view(), grid_of(step).get());
    const Picture thrown = project_drawing(line({320.f, 40.f}, {320.f, 360.f}, 16.f).draw);
    int on_step = 0;
    for_each_lit_place(step, thrown, [&](int x, int y, const Vector2f& place_mm) {
        if (is_lit(thrown, x, y) && place_mm.x() < 300.f - tolerance_mm) ++on_step;
    });
    EXPECT_EQ(on_step, 0);
}

TEST_F(ProjectedDisplayTest, BeforeThereIsAMappingThePictureIsShownAsItIs) {
    EXPECT_EQ(display_.size_px(), projector_size);
    const Picture thrown = project_drawing([](Canvas& canvas) {
        canvas.box({100.f, 50.f}, {300.f, 150.f}, 0.f, style::white);
    });
    EXPECT_TRUE(is_lit(thrown, 105, 55));
    EXPECT_TRUE(is_lit(thrown, 295, 145));
    EXPECT_FALSE(is_lit(thrown, 95, 45));
    EXPECT_FALSE(is_lit(thrown, 305, 155));
    display_.set_mapping(model_, view(), nullptr);
    EXPECT_EQ(display_.size_px(), (PixelSize{600, 400}));
}

TEST_F(ProjectedDisplayTest, ASurfaceOfWhichNothingIsKnownStaysDark) {
    auto grid = grid_of(flat);
    for (Eigen::Vector4f& point : grid->points_g_m) point.setZero();
    display_.set_mapping(model_, view(), grid.get());
    const Picture thrown = project_drawing(disc({300.f, 200.f}, 80.f).draw);
    EXPECT_EQ(std::count(thrown.rgba.begin(), thrown.rgba.end(), 0), 3 * 1280 * 800);
    grid = grid_of(flat);
    grid->version = 2;
    display_.set_mapping(model_, view(), grid.get());
    const Picture found = project_drawing(disc({300.f, 200.f}, 80.f).draw);
    EXPECT_GT(count_differences(thrown, found, 60), 1000) << "another version is another surface";
}

/// One pixel of the projector covers several of the view: their mean, not one of them.
TEST_F(ProjectedDisplayTest, SmallPatternsTurnGrey) {
    model_.focal_px *= 0.3f;
    display_.set_mapping(model_, view(), grid_of(flat).get());
    const Picture thrown = project_drawing([](Canvas& canvas) {
        for (float x = 0.f; x < 600.f; x += 2.f) canvas.box({x, 0.f}, {x + 1.f, 400.f}, 0.f, style::white);
    });
    int inside = 0, uneven = 0;
    for_each_lit_place(flat, thrown, [&](int x, int y, const Vector2f& place_mm) {
        if ((place_mm - Vector2f(300.f, 200.f)).cwiseAbs().maxCoeff() > 190.f) return;
        ++inside;
        if (std::abs(color_at(thrown, x, y).g - 128) > 60) ++uneven;
    });
    EXPECT_GT(inside, 100);
    EXPECT_LT(uneven, inside / 20);
}

}  // namespace
}  // namespace touchstone
