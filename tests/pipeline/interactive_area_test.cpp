#include "pipeline/interactive_area.hpp"

#include <gtest/gtest.h>
#include <random>

#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

class AreaTest : public testing::Test {
  protected:
    std::optional<InteractiveArea> fit(const std::vector<float>& depth_m) {
        SurfacePrediction background(device, make_map_shape(k));
        background.depth_m.write(test::padded<float>(background.shape, depth_m));
        return fit_interactive_area(background, k, {});
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(320, 240);
    Eigen::Vector3f n = Eigen::Vector3f(0.0f, -0.5f, -1.0f).normalized();
};

TEST_F(AreaTest, LiesOnTheTableInsideTheView) {
    const auto area = fit(test::render_depth_m(k, test::plane(n, -1.0f)));
    ASSERT_TRUE(area.has_value());
    for (const Eigen::Vector3f& corner :
         {area->origin_c_m, Eigen::Vector3f(area->origin_c_m + area->axis_u_c_m + area->axis_v_c_m)}) {
        EXPECT_NEAR(n.dot(corner), -1.0f, 0.002f);
    }
    for (const Eigen::Vector2f& corner : area_corners_px(*area, k)) {
        EXPECT_GT(corner.x(), -2.0f);
        EXPECT_GT(corner.y(), -2.0f);
        EXPECT_LT(corner.x(), 322.0f);
        EXPECT_LT(corner.y(), 242.0f);
    }
    // u to the right, v downwards, and it is worth having: the view's width at 1 m is 1 m.
    EXPECT_GT(area->axis_u_c_m.x(), 0.7f);
    EXPECT_GT(area->axis_v_c_m.y(), 0.5f);
    EXPECT_NEAR(area->axis_u_c_m.dot(area->axis_v_c_m), 0.0f, 1e-5f);
}

TEST_F(AreaTest, ThingsOnTheTableAndTheirShadowsBelongToIt) {
    std::vector<float> depth_m =
        test::render_depth_m(k, test::both(test::plane(n, -1.0f), test::sphere({0.0f, 0.0f, 0.95f}, 0.08f)));
    const auto plain = fit(test::render_depth_m(k, test::plane(n, -1.0f)));
    for (int y = 100; y < 140; ++y) {
        for (int x = 190; x < 200; ++x) depth_m[static_cast<std::size_t>(y * k.width_px + x)] = 0.0f;
    }
    const auto area = fit(depth_m);
    ASSERT_TRUE(area && plain);
    EXPECT_NEAR(area->axis_u_c_m.norm(), plain->axis_u_c_m.norm(), 0.06f);
    EXPECT_NEAR(area->axis_v_c_m.norm(), plain->axis_v_c_m.norm(), 0.06f);
}

TEST_F(AreaTest, StopsAtTheEdgeOfTheTable) {
    std::vector<float> depth_m = test::render_depth_m(k, test::plane(n, -1.0f));
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px / 2; ++x) depth_m[static_cast<std::size_t>(y * k.width_px + x)] = 2.5f;
    }
    const auto area = fit(depth_m);
    ASSERT_TRUE(area.has_value());
    EXPECT_GT(area->origin_c_m.x(), -0.03f);
}

TEST_F(AreaTest, NoPlaneGivesNoAreaAndTheWholeViewStandsIn) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(0.5f, 3.0f);
    std::vector<float> depth_m(static_cast<std::size_t>(k.width_px * k.height_px));
    for (float& z : depth_m) z = anywhere(random);
    EXPECT_FALSE(fit(depth_m).has_value());
    SurfacePrediction background(device, make_map_shape(k));
    background.depth_m.write(test::padded<float>(background.shape, depth_m));
    const auto corners = area_corners_px(whole_view_area(background, k), k);
    EXPECT_NEAR(corners[0].x(), 0.0f, 0.01f);
    EXPECT_NEAR(corners[2].x(), 320.0f, 0.01f);
    EXPECT_NEAR(corners[2].y(), 240.0f, 0.01f);
}

TEST(AreaUv, RunsFromZeroToOneOverTheArea) {
    const InteractiveArea area{{-0.5f, -0.2f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.4f, 0.3f}};
    EXPECT_TRUE(area_uv(area, area.origin_c_m).isZero(1e-6f));
    EXPECT_TRUE(area_uv(area, area.origin_c_m + area.axis_u_c_m + 0.5f * area.axis_v_c_m)
                    .isApprox(Eigen::Vector2f(1.0f, 0.5f)));
    const Eigen::Vector3f above = area.axis_u_c_m.cross(area.axis_v_c_m);
    EXPECT_TRUE(area_uv(area, area.origin_c_m + above).isZero(1e-6f))
        << "height above the area does not matter";
}

}  // namespace
}  // namespace touchstone
