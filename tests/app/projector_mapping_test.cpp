#include "app/projector_mapping.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/calibrate_command.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// A wall a metre before the camera, and a projector beside it.
class ProjectorMappingTest : public testing::Test {
  protected:
    ProjectorMappingTest() {
        BackgroundConfig config;
        config.volume.size_vox = 128;
        VolumePlacement placement{1.28f, RigidTransform::Identity()};
        placement.T_g_c.translation() = Vector3f(0.64f, 0.64f, -0.36f);
        background.emplace(device, config, k, placement);
        LiveMaps live(device, shape);
        const std::vector<float> wall(static_cast<std::size_t>(k.width_px * k.height_px), 1.0f);
        live.depth_m.write(test::padded<float>(shape, wall));
        live.normals_c.fill(0.0f);
        for (int frame = 0; frame < 5; ++frame) background->scan(live);

        ProjectorModel& model = saved.model;
        model.width_px = 1280;
        model.height_px = 800;
        model.focal_px = {1500.0f, 1500.0f};
        model.center_px = {640.0f, 780.0f};
        model.T_p_g.translation() = Vector3f(0.2f, 0.1f, 0.3f);
    }

    void follow(ProjectorMapping& mapping, InteractionState state = InteractionState::live) {
        mapping.follow(state, &*background, k);
    }
    void knock() {
        RigidTransform T_g_c = background->T_g_c();
        T_g_c.translate(Vector3f(0.02f, 0.0f, 0.01f));
        background->move_camera(T_g_c);
    }
    /// The pixel that lights the point before the camera.
    Eigen::Vector2f pixel_px(const ProjectorMapping& mapping) {
        const Vector3f point_g_m = background->T_g_c() * point_c_m;
        return *project(*mapping.model(), point_g_m);
    }

    const Vector3f point_c_m{0.1f, 0.05f, 1.0f};
    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(160, 120);
    MapShape shape = make_map_shape(k);
    std::optional<BackgroundModel> background;
    SavedProjector saved;
};

TEST_F(ProjectorMappingTest, WhatWasCalibratedInTheCamerasFrameHoldsInTheScans) {
    ProjectorMapping mapping(saved, false);
    EXPECT_FALSE(mapping.model());
    follow(mapping, InteractionState::scanning);
    EXPECT_FALSE(mapping.model()) << "before the table is live";
    follow(mapping);
    ASSERT_TRUE(mapping.model() && mapping.surface());
    EXPECT_LT((pixel_px(mapping) - *project(saved.model, point_c_m)).norm(), 0.01f);
    EXPECT_TRUE(mapping.note().empty());
}

/// Every fourth pixel, on the wall where it is seen.
TEST_F(ProjectorMappingTest, TheSurfaceIsWhatTheCameraSees) {
    ProjectorMapping mapping(saved, false);
    follow(mapping);
    const SurfaceGrid& grid = *mapping.surface();
    EXPECT_EQ(grid.width, 40);
    EXPECT_EQ(grid.height, 30);
    const Eigen::Vector4f& point = grid.points_g_m[static_cast<std::size_t>(15 * grid.width + 20)];
    const Vector3f wanted = background->T_g_c() * back_project(k, 80, 60, 1.0f);
    EXPECT_EQ(point.w(), 1.0f);
    EXPECT_LT((point.head<3>() - wanted).norm(), 0.002f);
    const auto before = mapping.surface();
    for (int frame = 0; frame < 70; ++frame) follow(mapping);
    EXPECT_EQ(mapping.surface(), before) << "nothing has changed";
}

TEST_F(ProjectorMappingTest, AKnockedCameraLeavesTheProjectorInTheRoomAndAsks) {
    ProjectorMapping mapping(saved, false);
    follow(mapping);
    const Vector3f room_point_g = background->T_g_c() * point_c_m;
    const Eigen::Vector2f before_px = *project(*mapping.model(), room_point_g);
    const int version = mapping.surface()->version;
    knock();
    follow(mapping);
    EXPECT_LT((*project(*mapping.model(), room_point_g) - before_px).norm(), 0.01f);
    EXPECT_NE(mapping.note().find("moved"), std::string::npos);
    EXPECT_GT(mapping.surface()->version, version);
    // A scan after that has another frame: the projector is where it was beside the camera as it is now.
    const Eigen::Vector2f knocked_px = pixel_px(mapping);
    follow(mapping, InteractionState::scanning);
    follow(mapping);
    EXPECT_LT((pixel_px(mapping) - knocked_px).norm(), 0.01f);
    EXPECT_NE(mapping.note().find("anew"), std::string::npos);
}

TEST_F(ProjectorMappingTest, OnOneMountAKnockMovesBoth) {
    ProjectorMapping mapping(saved, true);
    follow(mapping);
    const Eigen::Vector2f before_px = pixel_px(mapping);
    knock();
    follow(mapping);
    EXPECT_LT((pixel_px(mapping) - before_px).norm(), 0.01f);
    EXPECT_TRUE(mapping.note().empty());
}

TEST(CalibrationJson, IsThatOfTheContract) {
    CalibrationResult result{"touch", {}, "in words"};
    result.fit.model.kind = ProjectorModelKind::homography;
    result.fit.rms_px = 0.87654f;
    result.fit.rms_mm = 1.2f;
    result.fit.used = 11;
    const nlohmann::json json = nlohmann::json::parse(calibration_json(result));
    const nlohmann::json wanted = {{"method", "touch"}, {"model", "homography"}, {"rms_px", 0.877},
                                   {"rms_mm", 1.2},     {"points", 11},          {"verdict", "in words"}};
    EXPECT_EQ(json, wanted);
}

}  // namespace
}  // namespace touchstone
