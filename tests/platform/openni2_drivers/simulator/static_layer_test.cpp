#include "platform/openni2_drivers/simulator/static_layer.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace touchstone::sim {
namespace {

TEST(StaticLayer, AFlatTableIsThePlaneOfItsTilt) {
    const double height_m = 0.9;
    const double tilt = 30.0 * std::numbers::pi / 180.0;
    const TableView view = make_table_view(height_m, 30.0);
    const std::vector<float> depth_m = render_static_depth(make_scene(SimulatedScene::flat, 1, 0.5F), view);
    for (int v = 0; v < 480; v += 7) {
        // The table is height_m below the camera: z (cos(tilt) + y sin(tilt)) = height_m, y the ray's,
        // downward.
        const double y = (v - 239.5) / 575.8;
        const double expected = height_m / (std::cos(tilt) + y * std::sin(tilt));
        for (int u = 0; u < 640; u += 13)
            EXPECT_NEAR(depth_m[static_cast<std::size_t>(v * 640 + u)], expected, 3e-5) << u << ' ' << v;
    }
}

TEST(StaticLayer, EveryPixelLiesOnTheSceneAndNothingIsInFrontOfIt) {
    const TableView view = make_table_view(1.0, 25.0);
    for (const SimulatedScene kind :
         {SimulatedScene::curved, SimulatedScene::cluttered, SimulatedScene::bowl}) {
        const Scene scene = make_scene(kind, 2, 0.5F);
        const std::vector<float> depth_m = render_static_depth(scene, view);
        for (int i = 0; i < 640 * 480; i += 97) {
            const Vec3 ray = view.ray_c(static_cast<float>(i % 640), static_cast<float>(i / 640));
            const float z = depth_m[static_cast<std::size_t>(i)];
            EXPECT_NEAR(scene.distance(view.to_scene(z * ray)), 0.0F, 2e-5F);
            for (float before = 0.7F; before < 0.995F; before += 0.02F)
                EXPECT_GT(scene.distance(view.to_scene(before * z * ray)), 0.0F);
        }
    }
}

}  // namespace
}  // namespace touchstone::sim
