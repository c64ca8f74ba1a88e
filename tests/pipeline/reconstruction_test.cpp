// Figures 2 and 11 with a moving camera: no drift, nothing lost by being lost, nothing fused that does not
// fit.
#include "pipeline/reconstruction.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "tests/support/reconstructed_scene.hpp"
#include "tests/support/structured_light_noise.hpp"

namespace touchstone {
namespace {

using test::moved;
using test::ReconstructedScene;

const RigidTransform still = RigidTransform::Identity();

/// Depths are whole millimetres, pixels 9 mm and voxels 12.5 mm: 0.8 mm and 0.06 degrees were measured, after
/// which it stays (twice the pixels halve both).
TEST(Reconstruction, AStillCameraDoesNotDrift) {
    ReconstructedScene scene(test::corner());
    for (int frame = 0; frame < 30; ++frame) {
        const ReconstructionFrame result = scene.process(still);
        EXPECT_EQ(result.tracking.state, TrackingState::good) << result.tracking.reason;
        EXPECT_TRUE(result.fused);
    }
    EXPECT_LT(scene.error(still).mm, 1.0f);
    EXPECT_LT(scene.error(still).deg, 0.08f);
}

/// So many frames of a still camera that the model is not young any more (young_min_eigenvalue).
constexpr int settled = 12;

/// As many that the surface is not predicted anew in each frame.
constexpr int well_settled = 36;

/// Around the ball by 1.2 degrees and 20 mm a frame, and back.
void expect_orbit_comes_back(int frames_before) {
    ReconstructedScene scene(test::corner());
    const RigidTransform around = moved({0.0f, 0.0f, 1050.0f});
    const auto pose = [&](int frame) {
        const float angle_deg =
            15.0f * std::sin(std::numbers::pi_v<float> * static_cast<float>(frame) / 40.0f);
        return around * moved({0.0f, 0.0f, 0.0f}, angle_deg, {0.2f, 1.0f, 0.0f}) * around.inverse();
    };
    for (int frame = -frames_before; frame <= 40; ++frame) {
        const RigidTransform T_s_c = pose(std::max(frame, 0));
        const ReconstructionFrame result = scene.process(T_s_c);
        EXPECT_EQ(result.tracking.state, TrackingState::good) << result.tracking.reason;
        EXPECT_LT(scene.error(T_s_c).mm, 3.0f) << frame;
        EXPECT_TRUE(result.T_g_c.isApprox(scene.reconstruction.T_g_c(), 0.0f));
    }
    EXPECT_LT(scene.error(pose(40)).mm, 1.0f);
    EXPECT_LT(scene.error(pose(40)).deg, 0.05f);
}

TEST(Reconstruction, AnOrbitComesBackToWhereItBegan) {
    expect_orbit_comes_back(settled);
    expect_orbit_comes_back(well_settled);
}

std::size_t count_frames(const ReconstructedScene& scene, const char* stage) {
    return scene.reconstruction.stage_times().summary(stage).frames;
}

/// The young model in every frame, then in each third; colours in the frame after it.
TEST(Reconstruction, TheSurfaceIsPredictedAnewEveryThirdFrame) {
    ReconstructedScene scene(test::corner());
    const auto young = static_cast<std::size_t>(ReconstructionConfig{}.young_model_frames);
    const std::vector<std::uint16_t> seen_mm = scene.seen_mm(still);
    const std::vector<std::uint8_t> grey(3 * seen_mm.size(), 128);
    for (std::size_t frame = 0; frame < young; ++frame) (void)scene.process_mm(seen_mm, grey);
    EXPECT_EQ(count_frames(scene, "raycast"), young);
    EXPECT_EQ(count_frames(scene, "colour"), young);
    for (int frame = 0; frame < 9; ++frame) (void)scene.process_mm(seen_mm, grey);
    EXPECT_EQ(count_frames(scene, "raycast"), young + 3);
    EXPECT_EQ(count_frames(scene, "colour"), young + 3);
    ASSERT_NE(scene.reconstruction.volume().colors(), nullptr);
    EXPECT_FALSE(scene.reconstruction.volume().colors()->bricks().empty());
}

/// Layers of bricks along y in which a frame changed a voxel: even, odd.
std::array<int, 2> changed_bricks(const ReconstructedScene& scene, const std::vector<std::int32_t>& before) {
    const TsdfVolume& volume = scene.reconstruction.volume();
    const std::vector<std::int32_t> after = scene.voxels();
    std::array<int, 2> changed{};
    for (std::size_t brick = 0; brick < volume.brick_count(); ++brick) {
        const int slot = volume.slot(static_cast<int>(brick));
        if (slot < 0) continue;
        const auto first = static_cast<std::ptrdiff_t>(slot) * BRICK_VOXELS;
        if (std::equal(after.begin() + first, after.begin() + first + BRICK_VOXELS, before.begin() + first))
            continue;
        const auto side = static_cast<std::size_t>(volume.params().bricks_per_side);
        ++changed[brick / side % side % 2];
    }
    return changed;
}

/// A young model as a whole, then every second layer, in turns. Free space before a surface still gains
/// weight.
TEST(Reconstruction, ASettledModelIsFusedInTwoFrames) {
    ReconstructedScene scene(test::corner());
    for (int frame = 0; frame < settled; ++frame) (void)scene.process(still);
    std::vector<std::int32_t> before = scene.voxels();
    (void)scene.process(still);
    const auto young = changed_bricks(scene, before);
    EXPECT_GT(young[0], 20);
    EXPECT_GT(young[1], 20);
    for (int frame = settled + 1; frame < well_settled; ++frame) (void)scene.process(still);
    std::array<std::array<int, 2>, 2> turns{};
    for (auto& turn : turns) {
        before = scene.voxels();
        (void)scene.process(still);
        turn = changed_bricks(scene, before);
    }
    EXPECT_EQ(std::min(turns[0][0], turns[0][1]), 0);
    EXPECT_EQ(std::min(turns[1][0], turns[1][1]), 0);
    for (const std::size_t parity : {0U, 1U}) EXPECT_GT(turns[0][parity] + turns[1][parity], 20);
}

/// By 2.5 degrees a frame two frames turn by more than 4.
TEST(Reconstruction, ACameraThatTurnsNeedsThePredictionSooner) {
    ReconstructedScene scene(test::corner());
    for (int frame = 0; frame < well_settled; ++frame) (void)scene.process(still);
    const std::size_t before = count_frames(scene, "raycast");
    for (int frame = 1; frame <= 6; ++frame)
        (void)scene.process(moved({0.0f, 0.0f, 0.0f}, 2.5f * static_cast<float>(frame), {0.0f, 1.0f, 0.0f}));
    EXPECT_EQ(count_frames(scene, "raycast") - before, 3u);
}

/// With a Kinect's noise, a wall and nothing else: along it there is nothing to go by, and the noise of the
/// model's normals must not be taken for it.
TEST(Reconstruction, BeforeAnEmptyWallTheCameraStays) {
    ReconstructedScene scene(test::wall({0.2, -0.1, 1.0}, 1.2));
    const std::vector<float> wall_m =
        test::view_of(scene.k, test::wall({0.2, -0.1, 1.0}, 1.2), still).depth_m;
    std::mt19937 random(7);
    for (int frame = 0; frame < 30; ++frame) {
        const ReconstructionFrame result = scene.process_mm(test::sense({}, scene.k, wall_m, random));
        EXPECT_EQ(result.tracking.state, TrackingState::good) << result.tracking.reason;
    }
    EXPECT_LT(scene.error(still).mm, 1.0f);
    EXPECT_LT(scene.error(still).deg, 0.1f);
}

/// A picture on the wall tells how the camera slides: 3 mm a frame. Without colour nobody can know.
void expect_slide_is_seen(bool use_color) {
    ReconstructedScene scene(test::wall({0.0, 0.0, 1.0}, 1.2), use_color);
    RigidTransform T_s_c = still;
    for (int frame = -settled; frame < 10; ++frame) {
        const auto steps = static_cast<float>(std::max(frame, 0));
        T_s_c = moved({3.0f * steps, -2.0f * steps, 0.0f});
        std::vector<std::uint8_t> rgb;
        for (int i = 0; i < scene.k.width_px * scene.k.height_px; ++i) {
            const Eigen::Vector3f p =
                T_s_c * (1.2f * test::pixel_ray(scene.k, i % scene.k.width_px, i / scene.k.width_px));
            const float value = 127.0f + 60.0f * std::sin(40.0f * p.x()) + 60.0f * std::cos(35.0f * p.y());
            rgb.insert(rgb.end(), 3, static_cast<std::uint8_t>(value));
        }
        EXPECT_EQ(scene.process_mm(scene.seen_mm(T_s_c), rgb).tracking.state, TrackingState::good);
    }
    if (use_color)
        EXPECT_LT(scene.error(T_s_c).mm, 1.0f);  // of 32 mm
    else
        EXPECT_LT(scene.error(still).mm, 0.3f);
}

TEST(Reconstruction, APaintedWallTellsHowTheCameraSlides) {
    expect_slide_is_seen(true);
    expect_slide_is_seen(false);
}

/// Hands before the lens, another place, a jump: the pose stays, no voxel changes, and when the view is back
/// tracking goes on.
TEST(Reconstruction, LostFramesChangeNothing) {
    ReconstructedScene scene(test::corner());
    for (int frame = 0; frame < 5; ++frame)
        (void)scene.process(moved({2.0f * static_cast<float>(frame), 0.0f, 0.0f}));
    const RigidTransform before = scene.reconstruction.T_g_c();
    const std::vector<std::int32_t> voxels = scene.voxels();
    const std::vector<std::uint16_t> black(static_cast<std::size_t>(scene.k.width_px * scene.k.height_px), 0);
    std::vector<std::uint16_t> hand = black;
    for (std::size_t i = 0; i < hand.size(); ++i) hand[i] = static_cast<std::uint16_t>(350 + i % 160);
    for (const auto& depth_mm : {black, hand, scene.seen_mm(moved({200.0f, 0.0f, 0.0f})), black}) {
        const ReconstructionFrame result = scene.process_mm(depth_mm);
        EXPECT_EQ(result.tracking.state, TrackingState::lost);
        EXPECT_FALSE(result.tracking.reason.empty());
        EXPECT_FALSE(result.fused);
        EXPECT_TRUE(result.T_g_c.isApprox(before, 0.0f));
        EXPECT_EQ(scene.voxels(), voxels);
    }
    const RigidTransform back = moved({15.0f, 5.0f, -10.0f}, 1.0f);
    bool fused = false;
    for (int frame = 0; frame < 6; ++frame) {
        const ReconstructionFrame result = scene.process(back);
        EXPECT_EQ(result.tracking.state, TrackingState::good) << result.tracking.reason;
        fused = result.fused;
    }
    EXPECT_TRUE(fused);
    EXPECT_LT(scene.error(back).mm, 1.0f);
}

/// Three fifths of the view are covered: the pose follows, but nothing is fused.
TEST(Reconstruction, PoorFramesAreFollowedAndNotFused) {
    ReconstructedScene scene(test::corner());
    for (int frame = 0; frame < settled; ++frame) (void)scene.process(still);
    const std::vector<std::int32_t> voxels = scene.voxels();
    const RigidTransform T_s_c = moved({4.0f, -3.0f, 2.0f}, 0.3f);
    std::vector<std::uint16_t> covered = scene.seen_mm(T_s_c);
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (i % 160 < 96) covered[i] = static_cast<std::uint16_t>(covered[i] - 400);
    }
    const ReconstructionFrame result = scene.process_mm(covered);
    EXPECT_EQ(result.tracking.state, TrackingState::poor) << result.tracking.reason;
    EXPECT_FALSE(result.fused);
    EXPECT_EQ(scene.voxels(), voxels);
    EXPECT_LT(scene.error(T_s_c).mm, 2.0f);
}

/// Sensors give empty pictures while they start: the first picture with a surface in the cube begins the
/// model.
TEST(Reconstruction, BeginsWithTheFirstSurface) {
    ReconstructedScene scene(test::corner());
    const std::vector<std::uint16_t> black(static_cast<std::size_t>(scene.k.width_px * scene.k.height_px), 0);
    for (int frame = 0; frame < 3; ++frame) EXPECT_FALSE(scene.process_mm(black).fused && frame > 2);
    EXPECT_EQ(scene.reconstruction.volume().bricks_in_use(), 0);
    for (int frame = 0; frame < 3; ++frame) {
        const ReconstructionFrame result = scene.process(still);
        EXPECT_EQ(result.tracking.state, TrackingState::good) << result.tracking.reason;
    }
    EXPECT_GT(scene.reconstruction.volume().bricks_in_use(), 100);
}

/// A box of 180 mm is held 0.75 m away before a wall; one of the arms comes from nearer, the other from
/// farther.
TEST(Reconstruction, TheCubeLiesAroundWhatIsHeldNotAroundAHand) {
    const Intrinsics k{575.8f, 575.8f, 319.5f, 239.5f, 640, 480, {0, 0}};
    std::vector<std::uint16_t> depth_mm(640 * 480, 1800);
    const auto put = [&](int left, int top, int right, int bottom, std::uint16_t z_mm) {
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) depth_mm[static_cast<std::size_t>(y * 640 + x)] = z_mm;
    };
    put(242, 160, 397, 320, 670);  // the front of the box
    put(0, 240, 270, 290, 550);
    put(380, 190, 640, 230, 800);
    const auto T_g_c = place_camera({depth_mm, k}, 0.32f);
    ASSERT_TRUE(T_g_c.has_value());
    const Eigen::Vector3f middle_c_m = T_g_c->inverse() * Eigen::Vector3f::Constant(0.16f);
    EXPECT_LT((middle_c_m - Eigen::Vector3f(0.0f, 0.0f, 0.75f)).cwiseAbs().maxCoeff(), 0.02f)
        << middle_c_m.transpose();
    EXPECT_FALSE(place_camera({std::vector<std::uint16_t>(640 * 480, 0), k}, 0.32f).has_value());
}

/// One noise is every stage's: of a sensor four times as good, residuals are four times as many sigmas.
TEST(Reconstruction, ResidualsAreInSigmasOfTheSensor) {
    const auto rms_sigmas = [](float share) {
        const Device device(DeviceConfig{});
        ReconstructionConfig config = ReconstructedScene::config(false);
        config.noise = {0.0012f * share, 0.0019f * share, 0.4f, 0.0001f * share};
        const Intrinsics k = test::small_camera(160, 120);
        const auto depth_mm = test::to_mm(test::view_of(k, test::corner(), still).depth_m);
        Reconstruction reconstruction(device, config, k, moved({800.0f, 800.0f, -200.0f}));
        (void)reconstruction.process({depth_mm, k});
        return reconstruction.process({depth_mm, k}).tracking.rms_sigmas;
    };
    EXPECT_NEAR(rms_sigmas(0.25f) / rms_sigmas(1.0f), 4.0f, 1.5f);
}

}  // namespace
}  // namespace touchstone
