#include "pipeline/projector_squares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using Eigen::Vector4f;
using testing::HasSubstr;

constexpr int camera_width_px = 320, camera_height_px = 240;
constexpr float limit_mm = 5.0f;

/// The camera looks straight down from a metre on a table 1 m by 0.75 m with a low ridge along its middle.
std::vector<Vector4f> table_points() {
    std::vector<Vector4f> points;
    for (int y = 0; y < camera_height_px; ++y) {
        for (int x = 0; x < camera_width_px; ++x) {
            const float right = (static_cast<float>(x) - 159.5f) / 320.0f;
            const float down = (static_cast<float>(y) - 119.5f) / 320.0f;
            points.emplace_back(right, down, 1.0f - 0.04f * std::exp(-right * right / 0.02f), 1.0f);
        }
    }
    return points;
}

InteractiveArea table_area() {
    InteractiveArea area;
    area.origin_c_m = {-0.48f, -0.36f, 1.0f};
    area.axis_u_c_m = {0.96f, 0.0f, 0.0f};
    area.axis_v_c_m = {0.0f, 0.72f, 0.0f};
    return area;
}

ProjectorModel projector_over_it(const Vector3f& moved_m = Vector3f::Zero()) {
    ProjectorModel model;
    model.width_px = 1280;
    model.height_px = 800;
    model.focal_px = {1400.0f, 1400.0f};
    model.center_px = {640.0f, 780.0f};
    model.distortion = {0.02f, -0.01f, 0.0f, 0.0f};
    model.T_p_g.translation() = Vector3f(0.0f, -0.35f, 0.2f) - moved_m;
    return model;
}

struct Room {
    float dark = 60.0f, light = 120.0f;  ///< grey levels
    std::vector<Vector4f> points = table_points();
};

std::vector<std::vector<float>> see(const ProjectorSquares& squares, const ProjectorModel& truth,
                                    const Room& room) {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0.0f, 1.5f);
    std::vector<std::vector<float>> seen;
    const std::vector<Vector4f> points = table_points();
    for (int pattern = 0; pattern < squares.patterns(); ++pattern) {
        const std::vector<std::uint8_t> gray = draw_pattern(squares, pattern);
        std::vector<float>& picture = seen.emplace_back();
        for (const Vector4f& point : points) {
            const auto at = project(truth, point.head<3>());
            const int x = at ? static_cast<int>(std::lround(at->x())) : -1;
            const int y = at ? static_cast<int>(std::lround(at->y())) : -1;
            const bool inside = x >= 0 && y >= 0 && x < squares.width_px && y < squares.height_px;
            const bool is_lit = inside && gray[static_cast<std::size_t>(y * squares.width_px + x)] != 0;
            picture.push_back(room.dark + (is_lit ? room.light : 0.0f) + noise(random));
        }
    }
    return seen;
}

ProjectorCheck check(const ProjectorModel& truth, const Room& room = {}) {
    const ProjectorModel model = projector_over_it();
    const ProjectorSquares squares = choose_squares(model, room.points, camera_width_px, table_area());
    const SeenSquares seen = find_squares(squares, see(squares, truth, room), room.points, camera_width_px);
    return judge_squares(model, static_cast<int>(squares.corners_px.size()), seen, table_area(), limit_mm);
}

TEST(ProjectorSquares, EachHasItsOwnNumber) {
    const ProjectorSquares squares =
        choose_squares(projector_over_it(), table_points(), camera_width_px, table_area());
    EXPECT_EQ(squares.corners_px.size(), 12U);
    EXPECT_EQ(squares.patterns(), 6) << "dark, all, four bits";
    for (int a = 0; a < 12; ++a) {
        EXPECT_FALSE(squares.is_lit(0, a));
        EXPECT_TRUE(squares.is_lit(1, a));
        for (int b = 0; b < a; ++b) {
            bool differs = false;
            for (int pattern = 2; pattern < 6; ++pattern)
                differs = differs || squares.is_lit(pattern, a) != squares.is_lit(pattern, b);
            EXPECT_TRUE(differs) << a << " " << b;
        }
    }
    const std::vector<std::uint8_t> gray = draw_pattern(squares, 1);
    EXPECT_EQ(std::ranges::count(gray, 255), 12 * squares.side_px * squares.side_px) << "none covers another";
}

TEST(ProjectorSquares, ARightModelIsRightToAThirdOfTheCamerasPixel) {
    const ProjectorCheck found = check(projector_over_it());
    EXPECT_EQ(found.verdict, CheckVerdict::right);
    EXPECT_EQ(found.found, 12);
    EXPECT_LT(found.off_mm, 1.0f);
    EXPECT_THAT(describe(found), HasSubstr("right"));
}

/// By how far is told, too, also where squares fall where others should.
TEST(ProjectorSquares, AMovedProjectorIsFoundOutAndMeasured) {
    for (const float moved_m : {0.007f, 0.02f, 0.1f, 0.22f}) {
        const ProjectorCheck found = check(projector_over_it({moved_m, 0.0f, 0.0f}));
        EXPECT_EQ(found.verdict, CheckVerdict::off) << moved_m;
        EXPECT_NEAR(found.off_mm, 1000.0f * moved_m, 0.5f + 30.0f * moved_m);
        EXPECT_GE(found.found, 9) << "those that are still on the table";
        EXPECT_THAT(describe(found), HasSubstr("calibrate"));
    }
    EXPECT_EQ(check(projector_over_it({0.003f, 0.0f, 0.0f})).verdict, CheckVerdict::right) << "within 5 mm";
}

TEST(ProjectorSquares, WithoutLightNothingIsKnown) {
    Room dark;
    dark.light = 5.0f;
    const ProjectorCheck found = check(projector_over_it(), dark);
    EXPECT_EQ(found.verdict, CheckVerdict::unseen);
    EXPECT_THAT(describe(found), HasSubstr("no light"));
}

TEST(ProjectorSquares, LightBesideTheSurfaceIsSaid) {
    const ProjectorModel model = projector_over_it();
    const ProjectorSquares squares = choose_squares(model, table_points(), camera_width_px, table_area());
    const std::vector<Vector4f> nothing(table_points().size(), Vector4f::Zero());
    const SeenSquares seen = find_squares(squares, see(squares, model, {}), nothing, camera_width_px);
    EXPECT_EQ(seen.lights, 12);
    EXPECT_EQ(judge_squares(model, 12, seen, table_area(), limit_mm).verdict, CheckVerdict::beside);
    EXPECT_EQ(judge_squares(model, 2, seen, table_area(), limit_mm).verdict, CheckVerdict::too_few);
}

/// Light 5 mm off is 5.8 pixels off, and right by a limit of 5.5 mm; one square that lies elsewhere changes
/// nothing.
TEST(ProjectorSquares, TheVerdictIsOfMillimetresAndOfMostSquares) {
    const ProjectorModel model = projector_over_it();
    SeenSquares seen;
    for (int i = 0; i < 9; ++i) {
        const Vector3f at_g_m(-0.2f + 0.05f * static_cast<float>(i), 0.1f, 1.0f);
        const float off_m = i == 0 ? 0.05f : 0.001f * static_cast<float>(i);
        seen.matches.push_back({at_g_m, project(model, at_g_m + Vector3f(off_m, 0.0f, 0.0f)).value()});
    }
    const ProjectorCheck found = judge_squares(model, 9, seen, table_area(), 5.5f);
    EXPECT_EQ(found.verdict, CheckVerdict::right);
    EXPECT_NEAR(found.off_mm, 5.0f, 0.1f);
    EXPECT_NEAR(found.off_px, 5.83f, 0.1f);
    EXPECT_EQ(judge_squares(model, 9, seen, table_area(), 4.0f).verdict, CheckVerdict::off);
}

/// A lamp that went on, a square that a box covers in part.
TEST(ProjectorSquares, OtherLightsAreNoSquares) {
    const ProjectorModel model = projector_over_it();
    const std::vector<Vector4f> points = table_points();
    const ProjectorSquares squares = choose_squares(model, points, camera_width_px, table_area());
    auto seen = see(squares, model, {});
    for (std::size_t pattern = 1; pattern < seen.size(); ++pattern)
        for (int y = 60; y < 75; ++y)
            for (int x = 100; x < 115; ++x)
                seen[pattern][static_cast<std::size_t>(y * camera_width_px + x)] += 150.0f;
    const SeenSquares found = find_squares(squares, seen, points, camera_width_px);
    EXPECT_EQ(found.lights, 13);
    EXPECT_EQ(found.matches.size(), 12U) << "a light that is always on has number 15";
    EXPECT_THROW(find_squares(squares, std::span(seen).first(3), points, camera_width_px), Error);
}

TEST(ProjectorSquares, StandOnlyWhereTheSurfaceIsSeenAndEven) {
    std::vector<Vector4f> points = table_points();
    for (int y = 0; y < camera_height_px; ++y)
        for (int x = 0; x < 160; ++x)
            points[static_cast<std::size_t>(y * camera_width_px + x)] = Vector4f::Zero();
    const ProjectorSquares half = choose_squares(projector_over_it(), points, camera_width_px, table_area());
    EXPECT_EQ(half.corners_px.size(), 6U);
    for (int y = 0; y < camera_height_px; ++y)
        for (int x = 160; x < 240; ++x)
            points[static_cast<std::size_t>(y * camera_width_px + x)].z() -= (x / 6) % 2 == 0 ? 0.03f : 0.0f;
    const ProjectorSquares quarter =
        choose_squares(projector_over_it(), points, camera_width_px, table_area());
    EXPECT_EQ(quarter.corners_px.size(), 3U);
}

TEST(ProjectorModel, StretchesWithItsPicture) {
    ProjectorModel model = projector_over_it();
    const Vector3f point(0.1f, 0.2f, 1.0f);
    const Vector2f half(0.5f, 0.5f);
    const Vector2f at = *project(model, point) + half;
    const Vector2f small = *project(stretched(model, 640, 200), point) + half;
    EXPECT_LT((small - at.cwiseProduct(Vector2f(0.5f, 0.25f))).norm(), 1e-3f);
    model.kind = ProjectorModelKind::homography;
    model.plane_g = table_area();
    model.H_px_uv << 1200.0f, 20.0f, 30.0f, -15.0f, 740.0f, 20.0f, 0.02f, 0.05f, 1.0f;
    const Vector2f flat = *project(model, point) + half;
    const Vector2f small_flat = *project(stretched(model, 640, 200), point) + half;
    EXPECT_LT((small_flat - flat.cwiseProduct(Vector2f(0.5f, 0.25f))).norm(), 1e-3f);
}

}  // namespace
}  // namespace touchstone
