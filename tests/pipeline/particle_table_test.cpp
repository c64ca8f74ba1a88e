// A flat table at 1 m that faces the camera: what is poured, what stands for a hand, what is gone.
#include "pipeline/particle_table.hpp"

#include <gtest/gtest.h>

#include "tests/support/distance_snapshot.hpp"
#include "tests/support/oriented_scene.hpp"

namespace touchstone {
namespace {

constexpr float table_m = 1.0f;

class ParticleTableTest : public testing::Test {
  protected:
    ParticleTableTest() {
        const auto depth = [&](float z_m) { return std::vector<float>(pixels_, z_m); };
        live_.depth_m.write(test::padded<float>(live_.shape, depth(table_m)));
        background_.depth_m.write(test::padded<float>(live_.shape, depth(table_m)));
        T_g_c_.translation() = Eigen::Vector3f(0.32f, 0.32f, -0.68f);
    }

    /// The table is the plane z = 0.32 m of the cube, free space before it.
    static TsdfVolume table(const Device& device) {
        const VolumeConfig config{.size_vox = 64, .side_m = 0.64f};
        return restore_volume(
            device, test::snapshot_of(config, [](const Eigen::Vector3f& p) { return 0.32f - p.z(); }));
    }
    /// A hand of 40 x 30 pixels at 0.9 m in the middle.
    void put_hand() {
        std::vector<float> depth_m(pixels_, table_m);
        for (int y = 45; y < 75; ++y) {
            for (int x = 60; x < 100; ++x) {
                const auto at = static_cast<std::size_t>(y * k_.width_px + x);
                depth_m[at] = 0.9f;
                foreground_[at] = 255;
            }
        }
        live_.depth_m.write(test::padded<float>(live_.shape, depth_m));
    }
    ParticleTableFrame frame(std::span<const TouchEvent> touches = {}) {
        return {live_, background_, foreground_, volume_, T_g_c_, area_, touches, time_us_ += 33'333};
    }
    static TouchEvent finger(int id, TouchPhase phase) {
        TouchEvent event;
        event.tip.id = id;
        event.tip.surface_c_m = {0.0f, 0.0f, table_m};
        event.tip.axis_c = Eigen::Vector3f(0.0f, 0.8f, -0.6f);
        event.phase = phase;
        return event;
    }

    const Device device_{DeviceConfig{}};
    const Intrinsics k_ = test::small_camera(160, 120);
    const std::size_t pixels_ = 160 * 120;
    LiveMaps live_{device_, make_map_shape(k_)};
    SurfacePrediction background_{device_, live_.shape};
    std::vector<std::uint8_t> foreground_ = std::vector<std::uint8_t>(pixels_, 0);
    const TsdfVolume volume_ = table(device_);
    RigidTransform T_g_c_ = RigidTransform::Identity();
    const InteractiveArea area_{{-0.2f, -0.15f, table_m}, {0.4f, 0.0f, 0.0f}, {0.0f, 0.3f, 0.0f}};
    std::uint64_t time_us_ = 0;
};

/// 120 a second for two seconds, from before the tip (the hand is at +y); after two more all lie on the
/// table: their middles a radius of 5 mm before it, less 1 mm that they sink in at most 1.5 mm in a layer.
TEST_F(ParticleTableTest, AFingerPoursAndTheTableHolds) {
    ParticleTable table(device_, {}, k_);
    table.advance(frame());
    const std::array down{finger(1, TouchPhase::down)}, up{finger(1, TouchPhase::up)};
    table.advance(frame(down));
    for (int i = 0; i < 59; ++i) table.advance(frame());
    EXPECT_NEAR(table.count(), 240, 2);
    table.advance(frame(up));
    ParticleView view;
    for (int i = 0; i < 120; ++i) view = table.advance(frame());
    EXPECT_NEAR(table.count(), 240, 2) << "no more without a finger";
    float mean_y_m = 0.0f;
    for (const ParticleSphere& sphere : view.spheres) {
        EXPECT_LT(sphere.centre_c_m.z(), table_m - 0.002f) << "none has passed the table";
        EXPECT_GT(sphere.centre_c_m.z(), table_m - 0.06f);
        EXPECT_NEAR(sphere.shadow_c_m.z(), table_m, 1e-4f);
        const float over_m = table_m - sphere.centre_c_m.z() - 0.005f;
        EXPECT_NEAR(sphere.shadow, std::min(1.0f - over_m / 0.12f, 1.0f), 1e-3f) << "paler with its height";
        mean_y_m += sphere.centre_c_m.y() / static_cast<float>(view.spheres.size());
    }
    EXPECT_LT(mean_y_m, -0.01f) << "before the finger";
    for (std::size_t i = 1; i < view.spheres.size(); ++i)
        EXPECT_GE(view.spheres[i - 1].centre_c_m.z(), view.spheres[i].centre_c_m.z());
}

/// The events of their going up come while nobody can touch, and are not told here.
TEST_F(ParticleTableTest, LiftedFingersPourNoMore) {
    ParticleTable table(device_, {}, k_);
    const std::array down{finger(1, TouchPhase::down)};
    table.advance(frame());
    for (int i = 0; i < 5; ++i) table.advance(frame(down));
    const int poured = table.count();
    EXPECT_GT(poured, 0);
    table.lift_fingers();
    for (int i = 0; i < 5; ++i) table.advance(frame());
    EXPECT_EQ(table.count(), poured);
}

TEST_F(ParticleTableTest, FourFingersClear) {
    ParticleTable table(device_, {}, k_);
    std::vector<TouchEvent> fingers{finger(0, TouchPhase::down)};
    table.advance(frame());
    for (int i = 0; i < 10; ++i) table.advance(frame(fingers));
    EXPECT_GT(table.count(), 0);
    for (int id = 1; id < 4; ++id) fingers.push_back(finger(id, TouchPhase::down));
    table.advance(frame(fingers));
    EXPECT_EQ(table.count(), 0);
}

/// The second finger is on a control.
TEST_F(ParticleTableTest, OnlyFingersThatAreToPourDo) {
    ParticleTable table(device_, {}, k_);
    const std::array down{finger(1, TouchPhase::down), finger(2, TouchPhase::down)};
    const auto poured = [&](const std::vector<int>& pouring) {
        const int before = table.count();
        for (int i = 0; i < 10; ++i) {
            ParticleTableFrame each = frame(down);
            each.pouring = &pouring;
            table.advance(each);
        }
        return table.count() - before;
    };
    poured({});
    EXPECT_EQ(table.count(), 0);
    EXPECT_NEAR(poured({1}), 40, 2);
    EXPECT_NEAR(poured({1, 2}), 80, 4);
}

/// Half of gravity's pull along u: at rest they lean on nothing, so they run that way.
TEST_F(ParticleTableTest, OnATiltedTableTheyRunDown) {
    EXPECT_LT((tilted_down(area_, {0.0f, 0.0f}) - Eigen::Vector3f(0.0f, 0.0f, 1.0f)).norm(), 1e-6f);
    ParticleTable table(device_, {}, k_);
    const std::array down{finger(1, TouchPhase::down)}, up{finger(1, TouchPhase::up)};
    table.advance(frame());
    for (int i = 0; i < 20; ++i) table.advance(frame(down));
    table.advance(frame(up));
    const auto mean_x_m = [&](const Eigen::Vector2f& tilt, int frames) {
        ParticleView view;
        for (int i = 0; i < frames; ++i) {
            ParticleTableFrame each = frame();
            each.tilt = tilt;
            view = table.advance(each);
        }
        float sum_m = 0.0f;
        for (const ParticleSphere& sphere : view.spheres) sum_m += sphere.centre_c_m.x();
        return sum_m / static_cast<float>(view.spheres.size());
    };
    const float level_m = mean_x_m({0.0f, 0.0f}, 60);
    EXPECT_NEAR(level_m, 0.0f, 0.02f);
    EXPECT_GT(mean_x_m({1.0f, 0.0f}, 10), level_m + 0.03f);
}

/// Pixels of whole fours each way, in columns 60 to 99 and rows 45 to 74: 10 x 7; their fronts touch the
/// hand's surface.
TEST_F(ParticleTableTest, SpheresStandForTheForeground) {
    put_hand();
    const std::vector<Particle> spheres = foreground_spheres(frame(), k_, 4, 0.006f);
    ASSERT_EQ(spheres.size(), 70u);
    const RigidTransform T_c_g = T_g_c_.inverse();
    for (const Particle& sphere : spheres) {
        const Eigen::Vector3f centre_c_m = T_c_g * sphere.position_m;
        const Eigen::Vector3f front_c_m = centre_c_m - 0.006f * centre_c_m.normalized();
        EXPECT_NEAR(front_c_m.z(), 0.9f, 1e-4f);
    }
}

/// The same hand at rest, and told by its fingertip to move at 0.5 m/s along u: only the one that moves takes
/// along what lies on it. It stays where it is in the picture, so that nothing else pushes.
TEST_F(ParticleTableTest, AMovingHandTakesAlongWhatLiesOnIt) {
    put_hand();
    ParticleTableConfig config;
    config.still_step_px = 1;  // as dense on the hand as four pixels of a Kinect
    const auto mean_x_m = [&](float speed) {
        ParticleTable table(device_, config, k_);
        TouchEvent spout = finger(1, TouchPhase::down);
        spout.tip.surface_c_m = {0.0f, 0.03f, 0.88f};  // pours onto the middle of the hand
        ParticleView view = table.advance(frame());
        const std::array down{spout};
        for (int i = 0; i < 10; ++i) table.advance(frame(down));
        spout.phase = TouchPhase::up;
        const std::array up{spout};
        table.advance(frame(up));
        for (int i = 0; i < 12; ++i) table.advance(frame());
        for (int i = 0; i < 8; ++i) {
            HoverEvent hover;
            hover.tip.id = 2;
            hover.tip.surface_c_m = {speed * static_cast<float>(i) / 30.0f, 0.0f, 0.9f};
            const std::array hovers{hover};
            ParticleTableFrame each = frame();
            each.hovers = hovers;
            view = table.advance(each);
        }
        float sum_m = 0.0f;
        for (const ParticleSphere& sphere : view.spheres) sum_m += sphere.centre_c_m.x();
        return sum_m / static_cast<float>(view.spheres.size());
    };
    EXPECT_GT(mean_x_m(0.5f), mean_x_m(0.0f) + 0.01f);
}

TEST_F(ParticleTableTest, WhatIsRealIsInTheDepthOfTheView) {
    put_hand();
    ParticleTable table(device_, {}, k_);
    const ParticleView view = table.advance(frame());
    ASSERT_EQ(view.depth_mm.size(), pixels_);
    EXPECT_EQ(view.depth_mm[60 * 160 + 80], 900);
    EXPECT_EQ(view.depth_mm[10 * 160 + 80], 1000);
}

/// Over the edge of the cube there is no surface: what falls 20 cm below the table's plane is gone.
TEST_F(ParticleTableTest, WhatHasFallenIsForgotten) {
    ParticleTable table(device_, {}, k_);
    TouchEvent beyond = finger(1, TouchPhase::down);
    beyond.tip.surface_c_m = {0.6f, 0.0f, table_m};
    table.advance(frame());
    const std::array fingers{beyond};
    for (int i = 0; i < 10; ++i) table.advance(frame(fingers));
    EXPECT_GT(table.count(), 20);
    beyond.phase = TouchPhase::up;
    const std::array up{beyond};
    table.advance(frame(up));
    for (int i = 0; i < 45; ++i) table.advance(frame());
    EXPECT_EQ(table.count(), 0);
}

}  // namespace
}  // namespace touchstone
