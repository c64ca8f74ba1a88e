#include "pipeline/keyframes.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

#include "platform/image/png_file.hpp"
#include "platform/system/percentile.hpp"
#include "tests/support/analytic_scene.hpp"

namespace touchstone {
namespace {

const Intrinsics k = test::small_camera(160, 120);

/// A room of walls and balls without symmetry, as seen from a pose.
std::vector<std::uint16_t> view_of_room(const RigidTransform& T_g_c) {
    const RigidTransform T_c_g = T_g_c.inverse();
    const auto wall = [&](const Eigen::Vector3f& n_g, float d_m) {
        return test::plane(T_c_g.linear() * n_g, d_m - n_g.dot(T_g_c.translation()));
    };
    const auto ball = [&](float x, float y, float z, float radius_m) {
        return test::sphere(T_c_g * Eigen::Vector3f(x, y, z), radius_m);
    };
    test::DepthOfRay room = wall({0, 0, 1}, 2.5f);
    for (const test::DepthOfRay& part :
         {wall({0, 0, -1}, 1.5f), wall({1, 0, 0}, 1.8f), wall({-1, 0, 0}, 2.2f), wall({0, 1, 0}, 1.0f),
          wall({0, -1, 0}, 1.4f), ball(0.5f, 0.3f, 1.3f, 0.3f), ball(-0.9f, 0.4f, 1.0f, 0.45f),
          ball(-1.2f, -0.2f, -0.4f, 0.35f), ball(1.1f, 0.5f, -0.6f, 0.3f)})
        room = test::both(room, part);
    return test::to_mm(test::render_depth_m(k, room));
}

/// Looking about from one place in twelve steps of 30 degrees.
RigidTransform looking_about(int step) {
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.rotate(Eigen::AngleAxisf(static_cast<float>(step) * static_cast<float>(EIGEN_PI) / 6.0f,
                                   Eigen::Vector3f::UnitY()));
    return T_g_c;
}

/// Kinect noise and one pixel in twenty without a reading.
std::vector<std::uint16_t> noisy(std::vector<std::uint16_t> depth_mm) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (std::uint16_t& mm : depth_mm) {
        const double z = mm * 0.001;
        mm = random() % 20 == 0
                 ? std::uint16_t{0}
                 : static_cast<std::uint16_t>(
                       std::lround(mm + 1000.0 * (0.0012 + 0.0019 * (z - 0.4) * (z - 0.4)) * normal(random)));
    }
    return depth_mm;
}

KeyframeDatabase room_keyframes() {
    KeyframeDatabase keyframes;
    for (int step = 0; step < 12; ++step)
        EXPECT_TRUE(keyframes.add_if_new(make_small_picture({view_of_room(looking_about(step)), k}),
                                         looking_about(step)))
            << step;
    return keyframes;
}

float angle_deg(const RigidTransform& a, const RigidTransform& b) {
    return Eigen::AngleAxisf(a.linear().transpose() * b.linear()).angle() * 180.0f /
           static_cast<float>(EIGEN_PI);
}

TEST(SmallPicture, MedianOfTheValidDepthsOfEachBlock) {
    std::vector<std::uint16_t> depth_mm(160 * 120, 1000);
    for (int x = 0; x < 4; ++x) {
        depth_mm[static_cast<std::size_t>(x)] = 3000;     // block 0: 4 far pixels of 16
        depth_mm[static_cast<std::size_t>(160 + x)] = 0;  // and 4 without a reading
        for (int y = 0; y < 4; ++y) {
            if (x + y > 1) depth_mm[static_cast<std::size_t>(160 * y + 4 + x)] = 0;  // block 1: 3 valid of 16
            if (x > 0) depth_mm[static_cast<std::size_t>(160 * (116 + y) + 156 + x)] = 2000;  // last block
        }
    }
    const SmallPicture picture = make_small_picture({depth_mm, k});
    EXPECT_EQ(picture[0], 1000);
    EXPECT_EQ(picture[1], 0);
    EXPECT_EQ(picture[2], 1000);
    EXPECT_EQ(picture.back(), 2000);
}

TEST(SmallPicture, SmallerPicturesThanItsBlocks) {
    const Intrinsics tiny = test::small_camera(20, 15);
    const std::vector<std::uint16_t> depth_mm(20 * 15, 700);
    const SmallPicture picture = make_small_picture({depth_mm, tiny});
    EXPECT_EQ(std::ranges::count(picture, 700), 20 * 15);
}

TEST(Keyframes, ANoisyViewFindsItsKeyframe) {
    const KeyframeDatabase keyframes = room_keyframes();
    for (int step = 0; step < 12; ++step) {
        RigidTransform T_g_c = looking_about(step);
        T_g_c.translate(Eigen::Vector3f(0.02f, -0.01f, 0.02f));
        T_g_c.rotate(Eigen::AngleAxisf(0.035f, Eigen::Vector3f(1, 1, 1).normalized()));
        const auto matches = keyframes.most_similar(make_small_picture({noisy(view_of_room(T_g_c)), k}), 3);
        ASSERT_EQ(matches.size(), 3u);
        EXPECT_LT(angle_deg(matches[0].T_g_c, looking_about(step)), 0.1f) << step;
        EXPECT_LT(2.0f * matches[0].dissimilarity, matches[1].dissimilarity) << step;
        EXPECT_LE(matches[1].dissimilarity, matches[2].dissimilarity);
    }
}

TEST(Keyframes, AMirroredViewIsAnotherView) {
    KeyframeDatabase keyframes;
    std::vector<std::uint16_t> depth_mm = view_of_room(looking_about(0));
    const SmallPicture seen = make_small_picture({depth_mm, k});
    keyframes.add_if_new(seen, looking_about(0));
    for (auto row = depth_mm.begin(); row != depth_mm.end(); row += k.width_px)
        std::reverse(row, row + k.width_px);
    const SmallPicture mirrored = make_small_picture({depth_mm, k});
    EXPECT_EQ(keyframes.most_similar(seen, 1).at(0).dissimilarity, 0.0f);
    EXPECT_GT(keyframes.most_similar(mirrored, 1).at(0).dissimilarity, 0.2f);
    EXPECT_TRUE(keyframes.add_if_new(mirrored, looking_about(1)));
}

TEST(Keyframes, WhatWasSeenIsNotKeptAgain) {
    KeyframeDatabase keyframes = room_keyframes();
    for (int step = 0; step < 12; ++step)
        EXPECT_FALSE(keyframes.add_if_new(make_small_picture({noisy(view_of_room(looking_about(step))), k}),
                                          looking_about(step)));
    EXPECT_EQ(keyframes.keyframes().size(), 12u);
}

TEST(Keyframes, TheLimitIsKept) {
    KeyframeDatabase keyframes({.min_dissimilarity = 0.1f, .max_count = 5});
    int kept = 0;
    for (int step = 0; step < 12; ++step)
        kept += keyframes.add_if_new(make_small_picture({view_of_room(looking_about(step)), k}),
                                     looking_about(step));
    EXPECT_EQ(kept, 5);
    EXPECT_TRUE(keyframes.is_full());
    EXPECT_EQ(keyframes.most_similar(make_small_picture({view_of_room(looking_about(3)), k}), 1)
                  .at(0)
                  .dissimilarity,
              0.0f);
}

TEST(Keyframes, BlindViewsAreNeitherKeptNorFound) {
    KeyframeDatabase keyframes = room_keyframes();
    SmallPicture blind{};
    EXPECT_FALSE(keyframes.add_if_new(blind, looking_about(0)));
    EXPECT_TRUE(keyframes.most_similar(blind, 3).empty());
    EXPECT_TRUE(
        KeyframeDatabase().most_similar(make_small_picture({view_of_room(looking_about(0)), k}), 3).empty());
}

TEST(Keyframes, HalfAViewStillFindsItsKeyframe) {
    const KeyframeDatabase keyframes = room_keyframes();
    SmallPicture half = make_small_picture({view_of_room(looking_about(5)), k});
    for (std::size_t block = 0; block < half.size(); ++block) {
        if (block % small_width_px < small_width_px / 4) half[block] = 0;
    }
    const auto matches = keyframes.most_similar(half, 1);
    ASSERT_EQ(matches.size(), 1u);
    EXPECT_LT(angle_deg(matches[0].T_g_c, looking_about(5)), 0.1f);
    EXPECT_EQ(matches[0].dissimilarity, 0.0f);
}

/// Saved codes are compared with codes of today: other ferns need another version of the scan file.
TEST(Keyframes, TheFernsAreTheSameForEver) {
    SmallPicture ramp{};
    for (std::size_t block = 0; block < ramp.size(); ++block)
        ramp[block] = static_cast<std::uint16_t>(400 + 3 * block);
    const FernCode code = make_fern_code(ramp);
    std::uint32_t sum = 0;
    for (const std::uint8_t bits : code) sum = sum * 31 + bits;
    EXPECT_EQ(sum, 1010674945u);
}

RigidTransform pose_of_file(const std::filesystem::path& path) {
    std::ifstream file(path);
    RigidTransform T_g_c = RigidTransform::Identity();
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) file >> T_g_c.matrix()(row, column);
    }
    return T_g_c;
}

/// Keyframes from even frames of a real kitchen, asked with every seventh odd frame.
TEST(KeyframesRecording, AKitchenIsRecognised) {
    const auto folder = std::filesystem::path(TOUCHSTONE_SHARED_DIR) / "data" / "redkitchen-000-299";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
    const Intrinsics kinect{585.0f, 585.0f, 320.0f, 240.0f, 640, 480, {0, 0}};
    const auto picture_of = [&](int frame) {
        Image16 picture = read_png_16(folder / fmt::format("frame-{:06}.depth.png", frame));
        std::ranges::replace(picture.pixels, std::uint16_t{65535}, std::uint16_t{0});
        return make_small_picture({picture.pixels, kinect});
    };
    const auto pose_of = [&](int frame) {
        return pose_of_file(folder / fmt::format("frame-{:06}.pose.txt", frame));
    };
    KeyframeDatabase keyframes;
    for (int frame = 0; frame < 300; frame += 2) keyframes.add_if_new(picture_of(frame), pose_of(frame));
    std::vector<double> distance_mm, rotation_deg;
    for (int frame = 7; frame < 300; frame += 14) {
        const auto matches = keyframes.most_similar(picture_of(frame), 1);
        ASSERT_EQ(matches.size(), 1u) << frame;
        const RigidTransform truth = pose_of(frame);
        distance_mm.push_back(1000.0 * (matches[0].T_g_c.translation() - truth.translation()).norm());
        rotation_deg.push_back(angle_deg(matches[0].T_g_c, truth));
    }
    std::cout << fmt::format(
        "{} keyframes; nearest one found: median {:.0f} mm, {:.1f} degrees; 90 % {:.0f} mm, {:.1f} degrees\n",
        keyframes.keyframes().size(), percentile(distance_mm, 50), percentile(rotation_deg, 50),
        percentile(distance_mm, 90), percentile(rotation_deg, 90));
    EXPECT_LT(percentile(distance_mm, 90), 100.0);
    EXPECT_LT(percentile(rotation_deg, 90), 5.0);
}

}  // namespace
}  // namespace touchstone
