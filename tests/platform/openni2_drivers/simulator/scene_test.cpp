#include "platform/openni2_drivers/simulator/scene.hpp"

#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {
namespace {

constexpr SimulatedScene all_scenes[] = {SimulatedScene::flat, SimulatedScene::curved,
                                         SimulatedScene::cluttered, SimulatedScene::bowl,
                                         SimulatedScene::mixed};

Vec3 any_point(Random& random) {
    return {random.uniform(-0.5F, 0.5F), random.uniform(-0.4F, 0.4F), random.uniform(0.001F, 0.3F)};
}

TEST(Scene, TheTableIsAtZero) {
    const Scene scene = make_scene(SimulatedScene::flat, 1, 0.5F);
    EXPECT_FLOAT_EQ(scene.distance({0.3F, -0.2F, 0.125F}), 0.125F);
    EXPECT_EQ(scene.nearest({0.0F, 0.0F, 0.1F}), -1);
}

TEST(Scene, TheRidgeIsEightyMillimetresHighAndRunsIntoTheTable) {
    const Scene scene = make_scene(SimulatedScene::curved, 1, 0.5F);
    EXPECT_NEAR(scene.resting_height_m(0.0F, 0.0F, 0.0F), 0.08F, 1e-5F);
    EXPECT_NEAR(scene.resting_height_m(0.45F, 0.0F, 0.0F), 0.0F, 1e-5F);
    float before = scene.resting_height_m(0.0F, 0.0F, 0.0F);
    for (float x = 0.002F; x < 0.45F; x += 0.002F) {
        const float height = scene.resting_height_m(x, 0.0F, 0.0F);
        EXPECT_LE(height, before + 2e-5F) << x;
        EXPECT_LT(before - height, 0.004F) << "no step at " << x;
        before = height;
    }
}

TEST(Scene, TheBowlIsAPieceOfABall) {
    const Scene scene = make_scene(SimulatedScene::bowl, 1, 0.5F);
    const Shape& bowl = scene.shapes().front();
    EXPECT_NEAR(scene.resting_height_m(0.0F, 0.0F, 0.0F), 2.0F * bowl.thickness_m, 1e-5F);
    const float inner = bowl.radius_m - bowl.thickness_m;
    const float expected = bowl.center.z() - std::sqrt(inner * inner - 0.1F * 0.1F);
    EXPECT_NEAR(scene.resting_height_m(0.06F, 0.08F, 0.0F), expected, 1e-5F);
}

TEST(Scene, DistancesChangeByNoMoreThanTheWayAndPointToTheSurface) {
    Random random(5, 0);
    for (const SimulatedScene kind : all_scenes) {
        const Scene scene = make_scene(kind, 3, 0.5F);
        for (int i = 0; i < 2000; ++i) {
            const Vec3 p = any_point(random);
            const Vec3 q = p + 0.02F * Vec3(random.normal(), random.normal(), random.normal());
            EXPECT_LE(std::abs(scene.distance(p) - scene.distance(q)), (p - q).norm() + 1e-6F);
            for (const Shape& shape : scene.shapes())
                EXPECT_LE(shape.distance_bound(p), std::max(0.0F, shape.distance(p)) + 1e-6F);
            const float distance = scene.distance(p);
            if (distance < 0.0F) continue;
            // Where two surfaces are equally near there is no normal.
            const Vec3 foot = p - distance * scene.normal(p);
            if (scene.distance(foot) > 1e-4F) continue;
            EXPECT_NEAR(scene.distance(foot), 0.0F, 1e-4F);
        }
    }
}

TEST(Scene, ABallComesToRestOnTheSurface) {
    Random random(6, 0);
    for (const SimulatedScene kind : all_scenes) {
        const Scene scene = make_scene(kind, 4, 0.5F);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = any_point(random);
            const float z = scene.resting_height_m(p.x(), p.y(), 0.0075F);
            EXPECT_NEAR(scene.distance({p.x(), p.y(), z}), 0.0075F, 1e-5F);
        }
    }
}

TEST(Scene, ThingsInTheClutterKeepApartAndFollowTheSeed) {
    const Scene scene = make_scene(SimulatedScene::cluttered, 11, 0.5F);
    ASSERT_GE(scene.shapes().size(), 6U);
    for (const Shape& shape : scene.shapes())
        for (const Shape& other : scene.shapes()) {
            if (&shape != &other) {
                EXPECT_GT(other.distance(shape.center), 0.02F);
            }
        }
    const Scene again = make_scene(SimulatedScene::cluttered, 11, 0.5F);
    const Scene another = make_scene(SimulatedScene::cluttered, 12, 0.5F);
    EXPECT_EQ(scene.shapes()[0].center, again.shapes()[0].center);
    EXPECT_NE(scene.shapes()[0].center, another.shapes()[0].center);
}

}  // namespace
}  // namespace touchstone::sim
