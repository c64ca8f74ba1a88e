#include <cmath>
#include <gtest/gtest.h>

#include "pipeline/gray_code.hpp"
#include "pipeline/pattern_session.hpp"
#include "pipeline/projector_crosses.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr GrayCode code{64, 32, 8};
constexpr int width_px = 32, height_px = 16;
constexpr PatternSessionConfig config{.settle_frames = 2, .frames_per_pattern = 2, .quiet_frames = 3};

/// A camera whose pixel is two of the projector's; its picture is one frame late.
class LateCamera {
  public:
    std::vector<std::uint8_t> see(const PatternSession& session, bool hand = false) {
        const int late = last_;
        last_ = session.pattern().value_or(0);
        std::vector<std::uint8_t> rgb;
        for (int y = 0; y < height_px; ++y)
            for (int x = 0; x < width_px; ++x)
                rgb.insert(rgb.end(), 3, hand ? 250 : code.is_lit(late, 2 * x, 2 * y) ? 200 : 40);
        return rgb;
    }

  private:
    int last_ = 0;
};

void expect_every_cell_right(const CellPicture& cells) {
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const auto pixel = static_cast<std::size_t>(y * width_px + x);
            EXPECT_EQ(cells.column[pixel], x / 4) << x << " " << y;
            EXPECT_EQ(cells.row[pixel], y / 4) << x << " " << y;
        }
    }
}

TEST(PatternSession, ShowsEachPatternUntilItWasSeen) {
    PatternSession session(code.patterns(), config);
    LateCamera camera;
    int frames = 0;
    for (; session.pattern() && frames < 1000; ++frames) session.take(camera.see(session), false);
    EXPECT_EQ(frames, 4 * code.patterns() + 1) << "the last is believed a frame later";
    expect_every_cell_right(decode_cells(code, session.seen(), width_px, height_px));
    EXPECT_EQ(session.disturbances(), 0);
}

/// A hand covers everything for ten frames, and is noticed a frame late: what was seen last, one frame a
/// pattern, may be of the hand.
TEST(PatternSession, AHandThatComesInIsNoticedAndThePatternsRepeated) {
    PatternSessionConfig hasty = config;
    hasty.frames_per_pattern = 1;
    for (int begins = 5; begins < 3 * code.patterns(); ++begins) {
        PatternSession session(code.patterns(), hasty);
        LateCamera camera;
        int frames = 0;
        for (; session.pattern() && frames < 1000; ++frames) {
            const bool covers = frames >= begins && frames < begins + 10;
            const bool noticed = frames > begins && frames < begins + 10;
            session.take(camera.see(session, covers), noticed);
            EXPECT_TRUE(session.is_disturbed() || !noticed);
        }
        EXPECT_EQ(session.disturbances(), 1);
        EXPECT_FALSE(session.is_disturbed());
        expect_every_cell_right(decode_cells(code, session.seen(), width_px, height_px));
    }
}

TEST(PatternSession, WhatDisturbsForEverIsSaid) {
    PatternSession session(code.patterns(), config);
    LateCamera camera;
    const auto disturb_for_ever = [&] {
        for (int frame = 0; frame < 10000; ++frame) session.take(camera.see(session), frame % 6 == 0);
    };
    EXPECT_THROW(disturb_for_ever(), Error);
}

TEST(PatternSession, PicturesOfAnotherSizeAreRefused) {
    PatternSession session(code.patterns(), config);
    LateCamera camera;
    for (int frame = 0; frame < 5; ++frame) session.take(camera.see(session), false);
    const std::vector<std::uint8_t> small(30);
    EXPECT_THROW(for (int frame = 0; frame < 5; ++frame) session.take(small, false), Error);
}

TouchEvent touch_at(const Eigen::Vector3f& at_c_m, TouchPhase phase) {
    TouchEvent event;
    event.tip.id = 4;
    event.tip.surface_c_m = at_c_m;
    event.tip.state = FingerState::down;
    event.phase = phase;
    return event;
}

void tap(ProjectorCrosses& crosses, const Eigen::Vector3f& at_c_m, const Eigen::Vector3f& up_c_m,
         std::uint64_t time_us) {
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.translation() = Eigen::Vector3f(0.0f, 0.0f, 2.0f);
    const TouchEvent down[] = {touch_at(at_c_m, TouchPhase::down)},
                     move[] = {touch_at(up_c_m, TouchPhase::move)}, up[] = {touch_at(up_c_m, TouchPhase::up)};
    crosses.take(down, T_g_c, time_us);
    crosses.take(move, T_g_c, time_us + 33'000);
    crosses.take(up, T_g_c, time_us + 66'000);
}

/// A projector that lights 1 m by 0.625 m of a plane three metres away; the area is the middle half of it.
Eigen::Vector3f lit_m(const Eigen::Vector2f& pixel_px) {
    return {pixel_px.x() / 1280.0f, pixel_px.y() / 1280.0f, 1.0f};
}

InteractiveArea middle_half() {
    InteractiveArea area;
    area.origin_c_m = {0.25f, 0.15f, 3.0f};
    area.axis_u_c_m = {0.5f, 0.0f, 0.0f};
    area.axis_v_c_m = {0.0f, 0.3f, 0.0f};
    return area;
}

TEST(ProjectorCrosses, EachTouchIsAMatchInTheScansFrame) {
    ProjectorCrosses crosses(1280, 800, middle_half());
    std::vector<Eigen::Vector2f> shown_px;
    std::uint64_t time_us = 0;
    while (const auto cross = crosses.cross_px()) {
        const bool again = shown_px.size() == 12;
        if (!again) shown_px.push_back(*cross);
        const Eigen::Vector3f at = lit_m(*cross);
        const float drag_m = again && crosses.shown() != 14 ? 0.006f : 0.002f;
        tap(crosses, at, at + Eigen::Vector3f(drag_m, 0.0f, 0.0f), time_us += 1'000'000);
    }
    ASSERT_EQ(crosses.matches().size(), shown_px.size()) << "both rounds are of the same crosses";
    EXPECT_EQ(crosses.wanted(), 24);
    for (std::size_t i = 0; i < shown_px.size(); ++i) {
        const ProjectorMatch& match = crosses.matches()[i];
        EXPECT_EQ(match.pixel_px, shown_px[i]);
        const float mean_m = i == 2 ? 0.001f : 0.002f;  // of two frames of two touches
        EXPECT_NEAR(match.point_g_m.x(), lit_m(shown_px[i]).x() + mean_m, 1e-5f) << i;
        EXPECT_NEAR(match.point_g_m.z(), 3.0f, 1e-5f);
    }
    // The later ones are spread over the area, whose corners lie at 320, 192 and 960, 576.
    Eigen::AlignedBox2f box;
    for (std::size_t i = 4; i < shown_px.size(); ++i) box.extend(shown_px[i]);
    EXPECT_NEAR(box.min().x(), 320.0f + 0.08f * 640.0f, 5.0f);
    EXPECT_NEAR(box.max().y(), 192.0f + 0.92f * 384.0f, 5.0f);
}

TEST(ProjectorCrosses, AFingerThatMovedDoesNotCount) {
    ProjectorCrosses crosses(1280, 800, middle_half());
    tap(crosses, {0.0f, 0.0f, 1.0f}, {0.03f, 0.0f, 1.0f}, 0);
    EXPECT_TRUE(crosses.matches().empty());
    EXPECT_EQ(crosses.shown(), 0);
    EXPECT_NE(crosses.words().find("moved"), std::string::npos);
}

/// A plane seen from a metre away, on it a plateau of 40 mm with steep sides and a hollow, and a hole in what
/// is seen: the plateau's and the hollow's even middles are chosen.
TEST(ProjectorCrosses, WhatStandsOutIsFoundWhereItIsEven) {
    constexpr int view_px = 320;
    InteractiveArea area;
    area.origin_c_m = {-0.5f, -0.5f, 1.0f};
    area.axis_u_c_m = {1.0f, 0.0f, 0.0f};
    area.axis_v_c_m = {0.0f, 1.0f, 0.0f};
    std::vector<Eigen::Vector4f> points;
    for (int y = 0; y < view_px; ++y) {
        for (int x = 0; x < view_px; ++x) {
            const Eigen::Vector2f at =
                Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y)) / 320.0f -
                Eigen::Vector2f(0.5f, 0.5f);
            const bool on_plateau = (at - Eigen::Vector2f(0.2f, 0.1f)).cwiseAbs().maxCoeff() < 0.06f;
            const float hollow = 0.03f * std::exp(-(at + Eigen::Vector2f(0.2f, 0.2f)).squaredNorm() / 0.01f);
            const bool hole = at.x() < -0.3f && at.y() > 0.3f;
            if (hole)
                points.push_back(Eigen::Vector4f::Zero());
            else
                points.emplace_back(at.x(), at.y(), (on_plateau ? 0.96f : 1.0f) + hollow, 1.0f);
        }
    }
    const std::vector<Eigen::Vector3f> found = standing_out(points, view_px, area);
    ASSERT_GE(found.size(), 2U);
    EXPECT_LT((found[0] - Eigen::Vector3f(0.2f, 0.1f, 0.96f)).cwiseAbs().maxCoeff(), 0.06f);
    EXPECT_NEAR(found[0].z(), 0.96f, 1e-4f);
    EXPECT_LT((found[1].head<2>() + Eigen::Vector2f(0.2f, 0.2f)).norm(), 0.05f) << found[1].transpose();

    ProjectorCrosses crosses(1280, 800, middle_half(), {Eigen::Vector3f(0.5f, 0.3f, 2.9f)});
    std::uint64_t time_us = 0;
    while (const auto cross = crosses.cross_px())
        tap(crosses, lit_m(*cross), lit_m(*cross), time_us += 1'000'000);
    EXPECT_EQ(crosses.matches().size(), 12U);
    const Eigen::Vector2f stands_out_px(640.0f, 384.0f);
    EXPECT_TRUE(std::ranges::any_of(crosses.matches(), [&](const ProjectorMatch& match) {
        return (match.pixel_px - stands_out_px).norm() < 5.0f;
    })) << "what stands out takes the place of another";
}

TEST(ProjectorCrosses, TheSecondRoundPassesOverWhatNobodyTouchedAndKeepsWhatDisagreesApart) {
    ProjectorCrosses crosses(1280, 800, middle_half(), {}, {.patience_s = 5.0f});
    std::uint64_t time_us = 0;
    std::vector<Eigen::Vector2f> again_px;
    std::optional<Eigen::Vector2f> unreached_px;
    while (const auto cross = crosses.cross_px()) {
        if (crosses.shown() == 6) {
            unreached_px = *cross;
            crosses.take({}, RigidTransform::Identity(), time_us += 6'000'000);
            continue;
        }
        if (crosses.shown() >= 12) again_px.push_back(*cross);
        const float off_m = crosses.shown() == 15 ? 0.02f : 0.0f;
        const Eigen::Vector3f at = lit_m(*cross) + Eigen::Vector3f(off_m, 0.0f, 0.0f);
        tap(crosses, at, at, time_us += 1'000'000);
    }
    EXPECT_EQ(again_px.size(), 11U);
    EXPECT_EQ(std::ranges::count(again_px, *unreached_px), 0);
    EXPECT_EQ(crosses.matches().size(), 12U) << "eleven, and one that was touched elsewhere";
}

/// A finger that is lost for a frame while it lifts seems to touch twice.
TEST(ProjectorCrosses, ASecondTouchOfTheSameCrossIsNoneOfTheNext) {
    ProjectorCrosses crosses(1280, 800, middle_half());
    const Eigen::Vector3f first = lit_m(*crosses.cross_px());
    tap(crosses, first, first, 0);
    tap(crosses, first, first, 200'000);
    EXPECT_EQ(crosses.matches().size(), 1U);
    EXPECT_EQ(crosses.shown(), 1);
}

TEST(ProjectorCrosses, WhatNobodyCanReachIsPassedOver) {
    ProjectorCrosses crosses(1280, 800, middle_half(), {}, {.patience_s = 5.0f});
    std::uint64_t time_us = 0;
    for (; time_us < 5'500'000; time_us += 33'000) crosses.take({}, RigidTransform::Identity(), time_us);
    EXPECT_EQ(crosses.shown(), 1);
    EXPECT_TRUE(crosses.matches().empty());
    // Nobody is there: it comes to an end.
    for (; crosses.cross_px() && time_us < 60'000'000; time_us += 33'000)
        crosses.take({}, RigidTransform::Identity(), time_us);
    EXPECT_FALSE(crosses.cross_px());
}

}  // namespace
}  // namespace touchstone
