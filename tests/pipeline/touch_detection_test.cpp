#include "pipeline/touch_detection.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/support/finger_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// The whole stage on the device, from maps to events.
class TouchStage : public testing::Test {
  protected:
    TrackedTouches frame(float gap_m) {
        test::FingerScene scene(ground);
        add_hand(scene, gap_m);
        return detect(scene);
    }
    void add_hand(test::FingerScene& scene, float gap_m) const {
        scene.add_hand(touched_m, Vector3f(0.0f, 0.0f, -1.0f), Vector3f(0.3f, 0.7f, -0.6f).normalized(),
                       0.0075f, gap_m);
    }
    /// A finger drags 6 mm a frame to the right for 30 frames; an arm 70 mm wide passes 180 mm above the
    /// table in the other direction and hides it for nine. The events of all frames.
    std::vector<TouchEvent> crossed_drag() {
        std::vector<TouchEvent> events;
        frame(0.03f);
        frame(0.015f);
        for (int i = 0; i < 30; ++i) {
            touched_m.x() = -0.08f + 0.006f * static_cast<float>(i);
            const float arm_x_m = 0.15f - 0.010f * static_cast<float>(i);
            test::FingerScene scene(ground);
            add_hand(scene, 0.0f);
            scene.add({{arm_x_m, -0.3f, 0.82f}, {arm_x_m, 0.3f, 0.82f}, 0.035f, 0.035f});
            scene.add_noise(static_cast<unsigned>(i + 1));
            const TrackedTouches out = detect(scene);
            events.insert(events.end(), out.touches.begin(), out.touches.end());
        }
        return events;
    }
    TrackedTouches detect(test::FingerScene& scene) {
        scene.finish();
        background.depth_m.write(scene.padded_background);
        background.normals_c.write(scene.padded_normals);
        live.depth_m.write(scene.padded_live);
        live.filtered_m.write(scene.padded_live);
        mask.write(scene.padded_mask);
        const std::vector<PixelRegion> regions{scene.whole()};
        time_us += 33333;
        return stage.detect({live, background, mask, regions, area, time_us});
    }

    test::Ground ground = test::plane_ground({0.0f, 0.0f, 1.0f}, 1.0f);
    Vector3f touched_m{0.01f, -0.02f, 1.0f};
    Device device{DeviceConfig{}};
    Intrinsics k = test::cropped_kinect();
    LiveMaps live{device, make_map_shape(k)};
    SurfacePrediction background{device, make_map_shape(k)};
    Buffer<std::uint8_t> mask{device, map_pixels(make_map_shape(k))};
    InteractiveArea area{Vector3f(-0.2f, -0.2f, 1.0f), Vector3f(0.4f, 0.0f, 0.0f),
                         Vector3f(0.0f, 0.4f, 0.0f)};
    TouchDetection stage{device, TouchDetectionConfig{}, k};
    std::uint64_t time_us = 0;
};

TEST_F(TouchStage, ATapGoesDownWhereItTouchesAndUpAgain) {
    EXPECT_EQ(frame(0.040f).hovers.size(), 1u);
    EXPECT_EQ(frame(0.020f).hovers.size(), 1u);
    const TrackedTouches down = frame(0.0f);
    ASSERT_EQ(down.touches.size(), 1u);
    EXPECT_EQ(down.touches[0].phase, TouchPhase::down);
    EXPECT_LT((down.touches[0].tip.surface_c_m - touched_m).norm(), 2e-3f);
    const TrackedTouches up = frame(0.025f);
    ASSERT_EQ(up.touches.size(), 1u);
    EXPECT_EQ(up.touches[0].phase, TouchPhase::up);
}

TEST_F(TouchStage, TheTouchMapShowsTheFingertipOnly) {
    frame(0.0f);
    const std::vector<std::uint8_t> touch = test::cropped(make_map_shape(k), stage.touch_map().touch.read());
    int near = 0, far = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            if (touch[static_cast<std::size_t>(y * k.width_px + x)] == 0) continue;
            const float dx = static_cast<float>(x) - 119.5f - 5.8f,
                        dy = static_cast<float>(y) - 99.5f + 11.5f;
            (std::hypot(dx, dy) < 16.0f ? near : far)++;
        }
    }
    EXPECT_GT(near, 30);
    EXPECT_EQ(far, 0);
}

/// What the arm hides stays down where it was seen last, and goes on with its id; without time for hidden
/// touches it is lifted, and comes back as another.
TEST_F(TouchStage, ADragThatAnArmCrossesKeepsItsId) {
    const auto count = [](const std::vector<TouchEvent>& events, auto is) {
        return std::ranges::count_if(events, is);
    };
    const auto is_down = [](const TouchEvent& event) { return event.phase == TouchPhase::down; };
    const auto is_up = [](const TouchEvent& event) { return event.phase == TouchPhase::up; };
    const auto is_hidden = [](const TouchEvent& event) { return event.tip.state == FingerState::hidden; };
    const std::vector<TouchEvent> events = crossed_drag();
    EXPECT_EQ(count(events, is_down), 1);
    EXPECT_EQ(count(events, is_up), 0);
    EXPECT_GE(events.size(), 29u) << "one event a frame; noise may delay the first";
    for (const TouchEvent& event : events) EXPECT_EQ(event.tip.id, events.front().tip.id);
    EXPECT_GT(count(events, is_hidden), 3) << "longer than any lost finger is waited for";

    TouchDetectionConfig config;
    config.tracking.hidden_s = 0.0f;
    stage = TouchDetection(device, config, k);
    EXPECT_GT(count(crossed_drag(), is_down), 1);
}

TEST_F(TouchStage, WithoutForegroundTouchesEnd) {
    frame(0.02f);
    frame(0.0f);
    int ups = 0;
    for (int i = 0; i < 6; ++i) {
        time_us += 33333;
        for (const TouchEvent& touch : stage.detect({live, background, mask, {}, area, time_us}).touches)
            ups += touch.phase == TouchPhase::up;
    }
    EXPECT_EQ(ups, 1);
}

}  // namespace
}  // namespace touchstone
