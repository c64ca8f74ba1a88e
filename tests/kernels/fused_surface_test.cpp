#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "tests/support/fusion_chain.hpp"
#include "tests/support/global_scene.hpp"
#include "tests/support/structured_light_noise.hpp"

/// What a volume keeps of things that are hard to keep: thin, at edges, gone.
namespace touchstone {
namespace {

using test::FusionChain;

/// A Kinect's pixels (525 px focal length), a part of its picture.
Intrinsics narrow_camera() { return {525.0f, 525.0f, 79.5f, 59.5f, 160, 120, {0, 0}}; }

/// `size_vox`^3 voxels of 5.9 mm, 512^3 of 3 m.
VolumeConfig fine_volume(int size_vox) {
    VolumeConfig config;
    config.size_vox = size_vox;
    config.side_m = static_cast<float>(size_vox) * 3.0f / 512.0f;
    return config;
}

/// Looks along z at the middle of that cube, `distance_m` in front of its middle.
RigidTransform looking_at_middle(const VolumeConfig& config, float distance_m) {
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.translation() = Eigen::Vector3f(0.5f, 0.5f, 0.5f) * config.side_m;
    T_g_c.translation().z() -= distance_m;
    return T_g_c;
}

/// Another pose, up to `most_m` and `most_rad` away on each axis.
RigidTransform unsteady(const RigidTransform& T_g_c, float most_m, float most_rad, std::mt19937& random) {
    std::uniform_real_distribution<float> share(-1.0f, 1.0f);
    const auto any = [&] { return Eigen::Vector3f(share(random), share(random), share(random)); };
    const Eigen::Vector3f turn = most_rad * any();
    return T_g_c * Eigen::Translation3f(most_m * any()) * Eigen::AngleAxisf(turn.norm(), turn.normalized());
}

/// 20 mm at 1 m with a wall 60 cm behind it, poses up to 2 mm and 0.1 degrees wrong.
TEST(FusedSurface, ThinRodBeforeAWallSurvivesAHundredUnsteadyViews) {
    const VolumeConfig config = fine_volume(64);
    FusionChain chain(narrow_camera(), config);
    const RigidTransform T_g_c = looking_at_middle(config, 1.0f);
    const float middle_m = 0.5f * config.side_m;
    const test::Surface scene = test::nearest(
        {test::rod_along_y(middle_m, middle_m, 0.010f), test::box({-9.0f, -9.0f, 0.8f}, {9.0f, 9.0f, 2.6f})});
    std::mt19937 random(3);
    for (int frame = 0; frame < 100; ++frame) {
        const RigidTransform pose = unsteady(T_g_c, 0.08f, 0.0087f, random);
        chain.fuse(test::sense({}, chain.k, test::view_m(chain.k, scene, pose), random),
                   unsteady(pose, 0.002f, 0.002f, random));
    }
    const std::vector<float> seen = chain.seen_m(T_g_c), truth = test::view_m(chain.k, scene, T_g_c);
    int rod = 0, kept = 0, beside = 0;
    double error_m = 0.0;
    for (std::size_t pixel = 0; pixel < truth.size(); ++pixel) {
        const bool on_rod = truth[pixel] > 0.0f && truth[pixel] < 1.2f;
        rod += on_rod;
        kept += on_rod && seen[pixel] > 0.0f;
        beside += !on_rod && seen[pixel] > 0.0f;
        if (on_rod && seen[pixel] > 0.0f) error_m += seen[pixel] - truth[pixel];
    }
    EXPECT_GT(kept, rod * 95 / 100);
    EXPECT_LT(beside, 3 * chain.k.height_px) << "the rod grew by more than a pixel and a half on each side";
    EXPECT_LT(std::abs(error_m / kept), 0.0008) << "worn: its surface drew back";
}

TEST(FusedSurface, WhatLeftIsGoneWithinFifteenFramesOfAFullHistory) {
    const VolumeConfig config = fine_volume(64);
    FusionChain chain(narrow_camera(), config, {.most = 1});
    const RigidTransform T_g_c = looking_at_middle(config, 1.0f);
    const test::Surface wall = test::box({-9.0f, -9.0f, 0.30f}, {9.0f, 9.0f, 0.4f});
    const test::Surface thing = test::box({0.15f, 0.15f, 0.10f}, {0.23f, 0.23f, 0.3f});
    std::mt19937 random(3);
    const std::vector<float> before = test::view_m(chain.k, test::nearest({wall, thing}), T_g_c);
    const std::vector<float> after = test::view_m(chain.k, wall, T_g_c);
    for (int frame = 0; frame < 130; ++frame) chain.fuse(test::sense({}, chain.k, before, random), T_g_c);
    int left = 0, frame = 0;
    for (; frame < 100; ++frame) {
        chain.fuse(test::sense({}, chain.k, after, random), T_g_c);
        const std::vector<float> seen = chain.seen_m(T_g_c);
        left = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) left += seen[i] > 0.0f && seen[i] < after[i] - 0.03f;
        if (left == 0) break;
    }
    EXPECT_LE(frame, 15);
}

/// What is seen of a face, and how far from where it belongs.
struct Face {
    int expected = 0, seen = 0;
    double error_m = 0.0;
};

Face compare(const std::vector<float>& seen, const std::vector<float>& truth, float farthest_m) {
    Face face;
    for (std::size_t pixel = 0; pixel < truth.size(); ++pixel) {
        if (truth[pixel] <= 0.0f || truth[pixel] > farthest_m) continue;
        ++face.expected;
        if (seen[pixel] <= 0.0f) continue;
        ++face.seen;
        face.error_m += seen[pixel] - truth[pixel];
    }
    face.error_m /= std::max(1, face.seen);
    return face;
}

/// First from the front, then from behind.
class ThinSheet : public testing::TestWithParam<float> {};

TEST_P(ThinSheet, SeenFromBothSidesKeepsBothFaces) {
    const VolumeConfig config = fine_volume(64);
    FusionChain chain(narrow_camera(), config);
    const float middle_m = 0.5f * config.side_m, half_m = 0.5f * GetParam();
    const RigidTransform front = looking_at_middle(config, 1.0f);
    const RigidTransform turned(Eigen::Translation3f(2.0f * middle_m, 0.0f, 2.0f * middle_m) *
                                Eigen::AngleAxisf(std::numbers::pi_v<float>, Eigen::Vector3f::UnitY()));
    const RigidTransform back = turned * front;
    const test::Surface sheet =
        test::nearest({test::box({0.1f, 0.1f, middle_m - half_m}, {0.28f, 0.28f, middle_m + half_m}),
                       test::box({-9.0f, -9.0f, 2.5f}, {9.0f, 9.0f, 2.6f}),
                       test::box({-9.0f, -9.0f, -2.6f}, {9.0f, 9.0f, -2.5f})});
    std::mt19937 random(3);
    for (const RigidTransform& side : {front, back}) {
        for (int frame = 0; frame < 40; ++frame) {
            const RigidTransform pose = unsteady(side, 0.02f, 0.01f, random);
            chain.fuse(test::sense({}, chain.k, test::view_m(chain.k, sheet, pose), random), pose);
        }
    }
    for (const RigidTransform& side : {front, back}) {
        const Face face = compare(chain.seen_m(side), test::view_m(chain.k, sheet, side), 1.2f);
        EXPECT_GT(face.seen, face.expected * 95 / 100) << "all but its rim";
        EXPECT_LT(std::abs(face.error_m), 0.5f * chain.volume.params().voxel_m);
    }
}

INSTANTIATE_TEST_SUITE_P(Thickness, ThinSheet, testing::Values(0.006f, 0.010f, 0.020f));

}  // namespace
}  // namespace touchstone
