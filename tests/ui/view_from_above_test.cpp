#include "ui/view_from_above.hpp"

#include <gtest/gtest.h>

#include "ui/surface_geometry.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float rounding_m = 2e-5f, rounding_px = 0.1f;

/// A camera that looks aslant at an area 800 mm by 600 mm, turned against its picture.
class ViewFromAboveTest : public testing::Test {
  protected:
    ViewFromAboveTest() {
        frame_.state = "live";
        frame_.intrinsics = {570.f, 570.f, 319.5f, 239.5f, 640, 480, {0, 0}};
        frame_.T_g_c.linear() =
            Eigen::AngleAxisf(0.4f, Vector3f(0.3f, 0.8f, -0.2f).normalized()).toRotationMatrix();
        frame_.T_g_c.translation() = Vector3f(0.2f, -0.1f, 0.7f);
        const Eigen::Matrix3f turn =
            (Eigen::AngleAxisf(0.6f, Vector3f::UnitX()) * Eigen::AngleAxisf(0.3f, Vector3f::UnitZ()))
                .toRotationMatrix();
        frame_.area.axis_u_c_m = turn * Vector3f(0.8f, 0.f, 0.f);
        frame_.area.axis_v_c_m = turn * Vector3f(0.f, 0.6f, 0.f);
        frame_.area.origin_c_m =
            Vector3f(0.05f, 0.02f, 1.2f) - 0.5f * (frame_.area.axis_u_c_m + frame_.area.axis_v_c_m);
        frame_.has_area = true;
        view_ = make_view_from_above(frame_.area, frame_.T_g_c);
    }

    /// Camera frame: at shares of the area, so high over it.
    Vector3f over_area_c_m(float u, float v, float height_m) const {
        return frame_.area.origin_c_m + u * frame_.area.axis_u_c_m + v * frame_.area.axis_v_c_m +
               height_m * facing_normal(frame_.area);
    }

    Fingertip tip_at(const Vector3f& point_c_m) const {
        Fingertip tip;
        tip.surface_c_m = point_c_m;
        tip.pixel_px = project(frame_.intrinsics, point_c_m);
        return tip;
    }

    TableFrame frame_;
    ViewFromAbove view_;
};

TEST_F(ViewFromAboveTest, TheAreaFillsThePictureItsUAxisToTheRight) {
    EXPECT_EQ(view_.size_px(), (PixelSize{800, 600}));
    const TableFrame above = seen_from_above(frame_, view_);
    const std::array<Vector2f, 4> corners{Vector2f(-0.5f, -0.5f), Vector2f(799.5f, -0.5f),
                                          Vector2f(799.5f, 599.5f), Vector2f(-0.5f, 599.5f)};
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LT((above.area_px[i] - corners[i]).norm(), rounding_px) << i << ": " << above.area_px[i];
    EXPECT_TRUE(above.has_area);
    ASSERT_TRUE(above.view);
    EXPECT_EQ(above.view->width_px, 800);
    EXPECT_EQ(above.view->rgba.size(), 800U * 600U * 4U);
    EXPECT_EQ(above.view->rgba[0], 0);
    EXPECT_EQ(above.view->rgba[3], 255);
    EXPECT_EQ(seen_from_above(frame_, view_).view, above.view) << "the same picture";
}

TEST_F(ViewFromAboveTest, AWideAreaGetsFewerPixelsForAMillimetre) {
    frame_.area.axis_u_c_m *= 4.f;
    EXPECT_EQ(make_view_from_above(frame_.area, frame_.T_g_c).size_px(), (PixelSize{1600, 300}));
    EXPECT_EQ(
        make_view_from_above(frame_.area, frame_.T_g_c, {.px_per_mm = 0.25f, .most_px = 1600}).size_px(),
        (PixelSize{800, 150}));
}

TEST_F(ViewFromAboveTest, TouchesStayWhereTheyAreInTheScan) {
    const Vector3f point_c_m = over_area_c_m(0.2f, 0.7f, 0.05f);
    TouchEvent touch;
    touch.tip = tip_at(point_c_m);
    touch.tip.normal_c = facing_normal(frame_.area);
    touch.tip.axis_c = frame_.area.axis_u_c_m.normalized();
    frame_.touches = {touch};
    frame_.hovers = {HoverEvent{touch.tip}};
    const TableFrame above = seen_from_above(frame_, view_);
    for (const Fingertip& tip : {above.touches.at(0).tip, above.hovers.at(0).tip}) {
        EXPECT_LT((above.T_g_c * tip.surface_c_m - frame_.T_g_c * point_c_m).norm(), rounding_m);
        EXPECT_LT((project(above.intrinsics, tip.surface_c_m) - tip.pixel_px).norm(), rounding_px);
        EXPECT_LT((tip.normal_c - Vector3f(0.f, 0.f, -1.f)).norm(), 1e-4f);
        EXPECT_LT((tip.axis_c - Vector3f(1.f, 0.f, 0.f)).norm(), 1e-4f);
    }
}

TEST_F(ViewFromAboveTest, NamedAreasStayWhereTheyAreInTheScan) {
    ShownArea part;
    part.area = {over_area_c_m(0.25f, 0.25f, 0.f), 0.5f * frame_.area.axis_u_c_m,
                 0.5f * frame_.area.axis_v_c_m};
    part.corners_c_m = {over_area_c_m(0.25f, 0.25f, 0.f), over_area_c_m(0.75f, 0.25f, 0.f),
                        over_area_c_m(0.25f, 0.75f, 0.f)};
    part.corners_px.resize(3);
    frame_.areas = {part};
    const TableFrame above = seen_from_above(frame_, view_);
    const std::array<Vector2f, 3> places{Vector2f(199.5f, 149.5f), Vector2f(599.5f, 149.5f),
                                         Vector2f(199.5f, 449.5f)};
    for (std::size_t i = 0; i < 3; ++i) {
        const ShownArea& moved = above.areas.at(0);
        EXPECT_LT((above.T_g_c * moved.corners_c_m[i] - frame_.T_g_c * part.corners_c_m[i]).norm(),
                  rounding_m);
        EXPECT_LT((moved.corners_px[i] - places[i]).norm(), rounding_px);
    }
    EXPECT_LT((above.areas[0].area_px[2] - Vector2f(599.5f, 449.5f)).norm(), rounding_px);
    EXPECT_TRUE(seen_from_above(TableFrame(), view_).areas.empty());
}

/// 5 cm high and 30 cm off the middle: half a pixel, which is half a millimetre.
TEST_F(ViewFromAboveTest, HeightHardlyMovesAPlace) {
    TouchEvent low, high;
    low.tip = tip_at(over_area_c_m(0.1f, 0.2f, 0.f));
    high.tip = tip_at(over_area_c_m(0.1f, 0.2f, 0.05f));
    frame_.touches = {low, high};
    const TableFrame above = seen_from_above(frame_, view_);
    EXPECT_LT((above.touches[0].tip.pixel_px - Vector2f(79.5f, 119.5f)).norm(), rounding_px);
    EXPECT_LT((above.touches[1].tip.pixel_px - above.touches[0].tip.pixel_px).norm(), 0.5f);
}

TEST_F(ViewFromAboveTest, AFingerWithoutPointIsOnThePlane) {
    const Vector3f point_c_m = over_area_c_m(0.8f, 0.3f, 0.f);
    TouchEvent touch;
    touch.tip.pixel_px = project(frame_.intrinsics, point_c_m);
    frame_.touches = {touch};
    const TableFrame above = seen_from_above(frame_, view_);
    EXPECT_LT((above.T_g_c * above.touches.at(0).tip.surface_c_m - frame_.T_g_c * point_c_m).norm(), 1e-4f);
}

TEST_F(ViewFromAboveTest, ACrossLiesOnTheSurfaceThatIsThere) {
    auto grid = std::make_shared<SurfaceGrid>();
    *grid = {1, 160, 120, 4, {}};
    const Vector3f normal = facing_normal(frame_.area);
    const float plane_m = normal.dot(over_area_c_m(0.f, 0.f, 0.06f));
    for (int y = 0; y < grid->height; ++y)
        for (int x = 0; x < grid->width; ++x) {
            const Vector3f ray = back_project(frame_.intrinsics, 4 * x, 4 * y, 1.f);
            const Vector3f point_g_m = frame_.T_g_c * (plane_m / normal.dot(ray) * ray);
            grid->points_g_m.emplace_back(point_g_m.x(), point_g_m.y(), point_g_m.z(), 1.f);
        }
    frame_.surface = grid;
    const Vector3f point_c_m = over_area_c_m(0.3f, 0.6f, 0.06f);
    frame_.cross = CrossGuide{project(frame_.intrinsics, point_c_m), 0, 9, "Touch"};
    const TableFrame above = seen_from_above(frame_, view_);
    const auto expected = SurfaceGeometry(above, view_.size_px()).pixel_px(frame_.T_g_c * point_c_m);
    ASSERT_TRUE(expected && above.cross);
    EXPECT_LT((above.cross->pixel_px - *expected).norm(), rounding_px);
}

TEST_F(ViewFromAboveTest, ScenesFindTheirMillimetres) {
    const SurfaceGeometry surface(seen_from_above(frame_, view_), view_.size_px());
    EXPECT_NEAR(surface.mm_per_px({400.f, 300.f}), 1.f, 1e-3f);
    EXPECT_NEAR(surface.mm_per_px({0.f, 599.f}), 1.f, 1e-3f);
    EXPECT_NEAR(surface.room().box_px().sizes().x(), 799.f, 1.f);
    EXPECT_NEAR(surface.top_row(40.f).sizes().x(), 783.f, 1.f) << "8 mm off both edges";
}

TEST_F(ViewFromAboveTest, ParticlesAreMovedAndTheFarthestComesFirst) {
    auto particles = std::make_shared<ParticleView>();
    particles->intrinsics = frame_.intrinsics;
    particles->radius_m = 0.01f;
    particles->depth_mm.assign(640 * 480, 1200);
    for (const float height_m : {0.3f, 0.1f, 0.2f})
        particles->spheres.push_back(
            {over_area_c_m(0.5f, 0.5f, height_m), over_area_c_m(0.5f, 0.5f, 0.f), 1.f, 0});
    frame_.particles = particles;
    const TableFrame above = seen_from_above(frame_, view_);
    ASSERT_EQ(above.particles->spheres.size(), 3U);
    EXPECT_TRUE(above.particles->depth_mm.empty());
    EXPECT_EQ(above.particles->intrinsics.width_px, 800);
    const float area_z_m = above.particles->spheres[0].shadow_c_m.z();
    EXPECT_NEAR(area_z_m - above.particles->spheres[0].centre_c_m.z(), 0.1f, rounding_m);
    EXPECT_NEAR(area_z_m - above.particles->spheres[2].centre_c_m.z(), 0.3f, rounding_m);
}

TEST_F(ViewFromAboveTest, AFrameWithoutAreaIsBlackAndHasNoPlaces) {
    frame_.touches = {TouchEvent{tip_at(over_area_c_m(0.5f, 0.5f, 0.f)), TouchPhase::down}};
    frame_.has_area = false;
    frame_.state = "scanning";
    const TableFrame above = seen_from_above(frame_, view_);
    EXPECT_EQ(above.view, view_.black);
    EXPECT_FALSE(above.has_area);
    EXPECT_TRUE(above.touches.empty());
    EXPECT_EQ(above.state, "scanning");
    EXPECT_EQ(seen_from_above(frame_, ViewFromAbove{}).view, nullptr) << "no view yet";
}

TEST_F(ViewFromAboveTest, ItIsOfItsAreaHoweverTheCameraMoves) {
    EXPECT_TRUE(is_view_of(view_, frame_));
    const RigidTransform T_old_new(Eigen::AngleAxisf(0.1f, Vector3f::UnitY()));
    TableFrame moved = frame_;
    moved.T_g_c = frame_.T_g_c * T_old_new;
    moved.area = transformed(T_old_new.inverse(), frame_.area);
    EXPECT_TRUE(is_view_of(view_, moved));
    moved.area.axis_u_c_m *= 1.01f;
    EXPECT_FALSE(is_view_of(view_, moved));
    moved.has_area = false;
    EXPECT_FALSE(is_view_of(view_, moved));
    EXPECT_FALSE(is_view_of(ViewFromAbove{}, frame_));
}

}  // namespace
}  // namespace touchstone
