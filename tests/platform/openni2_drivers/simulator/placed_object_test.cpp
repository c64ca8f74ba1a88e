#include "platform/openni2_drivers/simulator/placed_object.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/pixel_box.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "platform/openni2_drivers/simulator/static_layer.hpp"
#include "platform/system/error.hpp"

namespace touchstone::sim {
namespace {

struct Table {
    explicit Table(const char* uri)
        : config(parse_simulator_uri(uri)),
          view(make_table_view(config.height_m, config.tilt_deg)),
          scene(make_scene(config.scene, config.seed, view.on_table(639.0F, 239.5F).x())) {}
    SimulatorConfig config;
    TableView view;
    Scene scene;
};

TEST(PlacedObject, AHandBringsItLeavesItAndTakesItAgain) {
    const Table table("flat?hands=0&object=box&put_s=2&take_s=6&cycle_s=10");
    const PlacedObject placed(table.config, table.scene, table.view);
    for (const double start_s : {0.0, 10.0, 490.0}) {
        EXPECT_FALSE(placed.at(start_s + 0.5).object || placed.at(start_s + 0.5).hand);
        const PlacedObject::Moment carried = placed.at(start_s + 1.5);
        ASSERT_TRUE(carried.object && carried.hand);
        EXPECT_GT(carried.object->center.z(), placed.resting().center.z() + 0.02F);
        const PlacedObject::Moment alone = placed.at(start_s + 4.5);
        ASSERT_TRUE(alone.object);
        EXPECT_FALSE(alone.hand);
        EXPECT_EQ(alone.object->center, placed.resting().center);
        EXPECT_TRUE(placed.at(start_s + 5.9).hand);
        EXPECT_GT(placed.at(start_s + 6.8).object->center.z(), placed.resting().center.z() + 0.02F);
        EXPECT_FALSE(placed.at(start_s + 7.5).object || placed.at(start_s + 7.5).hand);
    }
}

TEST(PlacedObject, StandsFreeOnTheTable) {
    for (const char* uri :
         {"cluttered?object=box&seed=1", "cluttered?object=can&seed=2", "flat?object=ball&seed=3",
          "cluttered?object=book&seed=4", "mixed?object=ball&seed=5"}) {
        const Table table(uri);
        const PlacedObject placed(table.config, table.scene, table.view);
        const Shape& shape = placed.resting();
        // On the table, and no other thing reaches into it.
        EXPECT_NEAR(shape.distance({shape.center.x(), shape.center.y(), 0.0F}), 0.0F, 0.003F) << uri;
        EXPECT_GT(table.scene.distance(shape.center), 0.9F * shape.center.z()) << uri;
        EXPECT_TRUE(placed.at(100.0).object) << uri << ": without a time it is there and stays";
    }
}

/// The marched picture against the distance: every drawn point lies on the shape, and the middle is drawn.
TEST(PlacedObject, IsDrawnWhereItIs) {
    for (const char* uri : {"flat?object=box&seed=1", "flat?object=can&seed=2", "flat?object=ball&seed=3"}) {
        const Table table(uri);
        const PlacedObject placed(table.config, table.scene, table.view);
        const std::vector<float> empty_m = render_static_depth(table.scene, table.view);
        Picture picture;
        clear_picture(picture, empty_m);
        draw_shape(picture, placed.resting(), table.view);
        std::vector<Shape> shapes = table.scene.shapes();
        shapes.push_back(placed.resting());
        const std::vector<float> both_m = render_static_depth(Scene(shapes), table.view);
        int drawn = 0, different = 0;
        for (std::size_t i = 0; i < empty_m.size(); ++i) {
            drawn += picture.depth_m[i] < empty_m[i];
            different += std::abs(picture.depth_m[i] - both_m[i]) > 1e-4F;
        }
        EXPECT_GT(drawn, 1000) << uri;
        EXPECT_LT(different, 10) << uri << ": rays along the outline";
    }
}

TEST(PlacedObject, FramesAreTheSameEveryTime) {
    const auto frame = [] {
        SimulatorSource source(parse_simulator_uri("flat?hands=0&object=can&put_s=1.5&take_s=5&seed=9"));
        SourceFrame picture;
        for (int i = 0; i < 40; ++i) source.next(picture);
        return picture.depth_mm;
    };
    EXPECT_EQ(frame(), frame());
}

TEST(PlacedObject, BadKeysAreNamed) {
    const auto refusal = [](const char* uri) -> std::string {
        try {
            parse_simulator_uri(uri);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(refusal("flat?object=cow").find("object must be none, box, ball, can or book"),
              std::string::npos);
    EXPECT_NE(refusal("flat?put_s=3").find("need an object"), std::string::npos);
    EXPECT_NE(refusal("flat?hands=0&object=box&put_s=-1").find("put_s"), std::string::npos);
    EXPECT_NE(refusal("flat?hands=0&object=box&put_s=3&take_s=4").find("take_s"), std::string::npos);
    EXPECT_NE(refusal("flat?hands=0&object=box&put_s=2&take_s=6&cycle_s=6").find("cycle_s"),
              std::string::npos);
    EXPECT_NE(refusal("flat?object=box&take_s=4").find("hands=0"), std::string::npos);
    EXPECT_NE(refusal("flat?object=box&put_s=4").find("empty"), std::string::npos);
    EXPECT_NE(refusal("room?object=box").find("not for the scene"), std::string::npos);
    EXPECT_EQ(refusal("flat?object=box&put_s=2&empty=8"), "");
}

TEST(BoundsOfBall, HoldEveryRayThatMeetsTheBall) {
    const Intrinsics k{575.8F, 575.8F, 319.5F, 239.5F, 640, 480, {0, 0}};
    for (const Vec3& center : {Vec3(0.0F, 0.0F, 1.0F), Vec3(-0.4F, 0.2F, 0.8F), Vec3(0.5F, -0.3F, 1.2F)}) {
        const float radius = 0.08F;
        const PixelBounds box = bounds_of_ball(center, radius, k);
        for (int v = 0; v < k.height_px; v += 3) {
            for (int u = 0; u < k.width_px; u += 3) {
                const Vec3 ray = Vec3((static_cast<float>(u) - k.cx_px) / k.fx_px,
                                      (static_cast<float>(v) - k.cy_px) / k.fy_px, 1.0F)
                                     .normalized();
                if ((center - center.dot(ray) * ray).norm() > radius) continue;
                EXPECT_TRUE(u >= box.left && u < box.right && v >= box.top && v < box.bottom)
                    << u << " " << v;
            }
        }
    }
}

}  // namespace
}  // namespace touchstone::sim
