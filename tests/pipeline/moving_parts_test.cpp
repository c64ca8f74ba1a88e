// What moves by itself before a moving camera: found, not fused, and it does not pull.
#include "pipeline/moving_parts.hpp"

#include <gtest/gtest.h>

#include "tests/support/map_access.hpp"
#include "tests/support/reconstructed_scene.hpp"

namespace touchstone {
namespace {

using test::moved;
using test::ReconstructedScene;

constexpr int settled = 12;

/// To and fro by 3 mm and 0.2 degrees a frame.
RigidTransform pose(int frame) {
    const float swing = std::sin(0.1f * static_cast<float>(std::max(frame, 0)));
    return moved({30.0f * swing, 10.0f * swing, 0.0f}, 2.0f * swing, {0.1f, 1.0f, 0.0f});
}

/// A plate of 40 x 50 pixels, 0.7 m away, that is carried through the picture.
constexpr int plate_width_px = 40, plate_height_px = 50;
int plate_left_px(int frame) { return 10 + 3 * frame; }
void put_plate(std::vector<std::uint16_t>& depth_mm, int frame, const Intrinsics& k) {
    for (int y = 30; y < 30 + plate_height_px; ++y) {
        for (int x = plate_left_px(frame); x < plate_left_px(frame) + plate_width_px; ++x)
            depth_mm[static_cast<std::size_t>(y * k.width_px + x)] = 700;
    }
}

TEST(MovingParts, NothingMovesInAStillScene) {
    ReconstructedScene scene(test::corner());
    for (int frame = -settled; frame < 40; ++frame) {
        const ReconstructionFrame result = scene.process(pose(frame));
        EXPECT_LT(result.moving_share, 0.0005f) << frame;
    }
}

/// As many that the surface is not predicted anew in each frame.
constexpr int well_settled = 36;

std::size_t predictions(const ReconstructedScene& scene) {
    return scene.reconstruction.stage_times().summary("raycast").frames;
}

TEST(MovingParts, APlateThatIsCarriedPastIsFoundAndLeavesNothing) {
    ReconstructedScene scene(test::corner());
    for (int frame = -well_settled; frame < 0; ++frame) (void)scene.process(pose(frame));
    const std::size_t predictions_before = predictions(scene);
    for (int frame = 0; frame < 25; ++frame) {
        std::vector<std::uint16_t> depth_mm = scene.seen_mm(pose(frame));
        put_plate(depth_mm, frame, scene.k);
        const ReconstructionFrame result = scene.process_mm(depth_mm);
        EXPECT_EQ(result.tracking.state, TrackingState::good) << frame << result.tracking.reason;
        EXPECT_NEAR(result.moving_share, 40.0f * 50.0f / (160.0f * 120.0f), 0.02f) << frame;
        EXPECT_LT(scene.error(pose(frame)).mm, 1.5f) << frame;
    }
    EXPECT_EQ(predictions(scene) - predictions_before, 25u) << "an old one lets it take the pose along";
    // The model where the plate is now, and has been: what is behind it.
    const std::vector<std::uint16_t> truth_mm = scene.seen_mm(pose(24));
    const std::vector<float> model_m =
        test::cropped(make_map_shape(scene.k), scene.reconstruction.prediction().depth_m.read());
    int compared = 0, astray = 0;
    for (std::size_t i = 0; i < model_m.size(); ++i) {
        if (model_m[i] <= 0.0f || truth_mm[i] == 0) continue;
        ++compared;
        astray += std::abs(1000.0f * model_m[i] - static_cast<float>(truth_mm[i])) > 100.0f;
    }
    EXPECT_GT(compared, 15000);
    EXPECT_LT(astray, compared / 200);
}

/// Somebody who comes in at the right side of the picture while the camera turns to that side: an arm, and
/// behind its edge the trunk. Where the trunk shows nobody has looked before, so that free space tells
/// nothing of it.
void put_arm_and_trunk(std::vector<std::uint16_t>& depth_mm, int frame, const Intrinsics& k) {
    constexpr int arm_px = 20, arm_mm = 600, trunk_mm = 760;
    const int left_px = k.width_px - std::min(4 * frame, 100);
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = left_px; x < k.width_px; ++x) {
            const float across = static_cast<float>(x - left_px - 60) / 60.0f;
            const float round_mm = 100.0f * std::sqrt(std::max(1.0f - across * across, 0.0f));
            depth_mm[static_cast<std::size_t>(y * k.width_px + x)] = static_cast<std::uint16_t>(
                x < left_px + arm_px ? static_cast<float>(arm_mm) : static_cast<float>(trunk_mm) - round_mm);
        }
    }
}

RigidTransform turned_to_the_right(int frame) {
    return moved({0.0f, 0.0f, 0.0f}, 0.4f * static_cast<float>(std::max(frame, 0)), {0.0f, 1.0f, 0.0f});
}

TEST(MovingParts, WhoComesInWithNewGroundIsFoundWhole) {
    ReconstructedScene scene(test::corner());
    for (int frame = -60; frame < 0; ++frame) (void)scene.process(turned_to_the_right(frame));
    for (int frame = 0; frame < 18; ++frame) {
        std::vector<std::uint16_t> depth_mm = scene.seen_mm(turned_to_the_right(frame));
        put_arm_and_trunk(depth_mm, frame, scene.k);
        const ReconstructionFrame result = scene.process_mm(depth_mm);
        EXPECT_EQ(result.tracking.state, TrackingState::good) << frame << result.tracking.reason;
        EXPECT_LT(scene.error(turned_to_the_right(frame)).mm, 1.5f) << frame;
        if (frame < 12) continue;
        EXPECT_NEAR(result.moving_share, 4.0f * static_cast<float>(frame) / 160.0f, 0.03f) << frame;
    }
}

}  // namespace
}  // namespace touchstone
