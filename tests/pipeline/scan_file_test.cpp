#include "pipeline/scan_file.hpp"

#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "platform/system/error.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/small_volume.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Where the fixed part of the content has what: see scan_file.hpp.
constexpr std::size_t at_size_vox = 0, at_side_m = 4, at_max_weight = 20, at_max_bricks = 24, at_fx = 28,
                      at_width = 44, at_pose = 52, at_brick_count = 100, at_color_count = 104,
                      at_keyframe_count = 108, at_bricks = 112;

SmallPicture some_picture(std::uint16_t start_mm) {
    SmallPicture picture{};
    for (std::size_t block = 0; block < picture.size(); ++block)
        picture[block] = static_cast<std::uint16_t>(start_mm + (block * 37) % 2000);
    return picture;
}

/// Voxels of every kind, bricks with and without colours, keyframes.
SavedScan some_scan() {
    SavedScan scan;
    scan.volume.config = test::small_volume();
    scan.volume.bricks = {0, 1, 7, 300, 511};
    scan.volume.color_bricks = {1, 511};
    std::mt19937 random(3);
    for (std::size_t i = 0; i < scan.volume.bricks.size() * BRICK_VOXELS; ++i)
        scan.volume.voxels.push_back(i % 3 == 0 ? 0 : static_cast<std::int32_t>(random()));
    for (std::size_t i = 0; i < scan.volume.color_bricks.size() * BRICK_VOXELS; ++i)
        scan.volume.colors.push_back(static_cast<std::uint32_t>(random()));
    scan.intrinsics = test::small_camera();
    scan.T_g_c = test::pose_in_front();
    KeyframeDatabase keyframes({.min_dissimilarity = 0.0f, .max_count = 3});
    keyframes.add_if_new(some_picture(500), test::pose_in_front());
    keyframes.add_if_new(some_picture(1500), RigidTransform::Identity());
    scan.keyframes.assign(keyframes.keyframes().begin(), keyframes.keyframes().end());
    return scan;
}

class ScanFile : public testing::Test {
  protected:
    std::string bytes(const std::filesystem::path& path) const {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    /// A file with this value in its content and a checksum that is right.
    template <class Value>
    void expect_refused_with(std::size_t place, Value value, const std::string& why) {
        save_scan(path_, some_scan());
        std::string content = read_checked_file(path_, scan_file_format);
        std::memcpy(content.data() + place, &value, sizeof value);
        write_checked_file(path_, scan_file_format, content);
        expect_refused(why);
    }
    void expect_refused(const std::string& why) {
        expect_error([&] { (void)load_scan(path_); }, ExitStatus::bad_data,
                     AllOf(HasSubstr(path_.string()), HasSubstr(why)));
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "room.scan", again_ = folder_ / "again.scan";
};

void expect_equal(const SavedScan& a, const SavedScan& b) {
    EXPECT_EQ(std::memcmp(&a.volume.config, &b.volume.config, sizeof a.volume.config), 0);
    EXPECT_EQ(a.volume.bricks, b.volume.bricks);
    EXPECT_EQ(a.volume.voxels, b.volume.voxels);
    EXPECT_EQ(a.volume.color_bricks, b.volume.color_bricks);
    EXPECT_EQ(a.volume.colors, b.volume.colors);
    EXPECT_EQ(std::memcmp(&a.intrinsics, &b.intrinsics, sizeof a.intrinsics), 0);
    EXPECT_EQ(a.T_g_c.matrix(), b.T_g_c.matrix());
    ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
    for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
        EXPECT_EQ(a.keyframes[i].T_g_c.matrix(), b.keyframes[i].T_g_c.matrix());
        EXPECT_EQ(a.keyframes[i].code, b.keyframes[i].code);
    }
}

TEST_F(ScanFile, SavedLoadedAndSavedAgainIsBitIdentical) {
    ASSERT_EQ(some_scan().keyframes.size(), 2u);
    save_scan(path_, some_scan());
    const SavedScan loaded = load_scan(path_);
    expect_equal(loaded, some_scan());
    save_scan(again_, loaded);
    EXPECT_EQ(bytes(path_), bytes(again_));
}

TEST_F(ScanFile, ARestoredVolumeGivesTheSameFile) {
    const Device device(DeviceConfig{});
    SavedScan scan = some_scan();
    scan.volume.color_bricks.clear();
    scan.volume.colors.clear();
    save_scan(path_, scan);
    SavedScan loaded = load_scan(path_);
    loaded.volume = take_snapshot(restore_volume(device, loaded.volume));
    save_scan(again_, loaded);
    EXPECT_EQ(bytes(path_), bytes(again_));
}

TEST_F(ScanFile, KeyframesAnswerAsBefore) {
    save_scan(path_, some_scan());
    const SavedScan loaded = load_scan(path_);
    const KeyframeDatabase before({}, some_scan().keyframes), after({}, loaded.keyframes);
    const auto expected = before.most_similar(some_picture(700), 2),
               found = after.most_similar(some_picture(700), 2);
    ASSERT_EQ(expected.size(), 2u);
    ASSERT_EQ(found.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(found[i].dissimilarity, expected[i].dissimilarity);
        EXPECT_EQ(found[i].T_g_c.matrix(), expected[i].T_g_c.matrix());
    }
}

TEST_F(ScanFile, AnEmptyVolume) {
    SavedScan empty;
    empty.volume.config = test::small_volume();
    empty.intrinsics = test::small_camera();
    save_scan(path_, empty);
    expect_equal(load_scan(path_), empty);
}

TEST_F(ScanFile, FlippedBitsAndTruncationAreRefused) {
    save_scan(path_, some_scan());
    const std::string whole = bytes(path_);
    const auto expect_refused_as = [&](const std::string& content) {
        std::ofstream(path_, std::ios::binary) << content;
        expect_refused("");
    };
    for (std::size_t place = 0; place < whole.size(); place += place < 64 ? 1 : 97) {
        std::string flipped = whole;
        flipped[place] = static_cast<char>(flipped[place] ^ (1 << place % 8));
        expect_refused_as(flipped);
    }
    for (std::size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 331)
        expect_refused_as(whole.substr(0, size));
}

TEST_F(ScanFile, MissingFileAndOtherVersion) {
    expect_error([&] { (void)load_scan(path_); }, ExitStatus::no_input, HasSubstr(path_.string()));
    FileFormat newer = scan_file_format;
    ++newer.version;
    write_checked_file(path_, newer, "whatever comes");
    expect_refused("a newer version");
}

TEST_F(ScanFile, VolumesThatCannotBe) {
    for (const int size : {0, -64, 63, 4096, std::numeric_limits<int>::min()})
        expect_refused_with(at_size_vox, size, "volume");
    for (const float side_m : {0.0f, -1.0f, 1e9f, std::nanf("")})
        expect_refused_with(at_side_m, side_m, "volume");
    for (const int weight : {0, 256}) expect_refused_with(at_max_weight, weight, "volume");
    for (const int bricks : {0, -1, (1 << 20) + 1}) expect_refused_with(at_max_bricks, bricks, "volume");
    expect_refused_with(at_max_bricks, 4, "bricks do not fit");
}

TEST_F(ScanFile, BricksThatDoNotFit) {
    expect_refused_with(at_size_vox, 56, "bricks do not fit");  // brick 511 is beyond a cube of 7 bricks
    // Lowest bytes of the steps 0, 1, 6, 293, 211.
    expect_refused_with(at_bricks + 1, std::uint8_t{0}, "bricks do not fit");      // brick 0 twice
    expect_refused_with(at_bricks + 15, std::uint8_t{0xff}, "bricks do not fit");  // the first below 0
}

TEST_F(ScanFile, CountsThatAreNotTrueTakeNoMemory) {
    for (const std::size_t place : {at_brick_count, at_color_count, at_keyframe_count}) {
        for (const std::uint32_t count : {6u, 1'000'000u, 0xffffffffu})
            expect_refused_with(place, count, "ends too early");
    }
    expect_refused_with(at_keyframe_count, 1u, "more in it");
    expect_refused_with(at_color_count, 1u, "more in it");
}

TEST_F(ScanFile, CamerasAndPosesThatCannotBe) {
    for (const float fx : {0.0f, -500.0f, std::nanf(""), std::numeric_limits<float>::infinity()})
        expect_refused_with(at_fx, fx, "camera is none");
    for (const int width : {0, -1, 100'000}) expect_refused_with(at_width, width, "camera is none");
    for (const float element : {std::nanf(""), 2.0f, -1.0f})
        expect_refused_with(at_pose, element, "pose is none");
    expect_refused_with(at_pose + 12, std::nanf(""), "pose is none");
}

TEST_F(ScanFile, WhatCouldNotBeLoadedIsNotSaved) {
    SavedScan unsorted = some_scan();
    std::swap(unsorted.volume.bricks[0], unsorted.volume.bricks[1]);
    SavedScan foreign_color = some_scan();
    foreign_color.volume.color_bricks[0] = 2;
    for (const SavedScan& scan : {unsorted, foreign_color}) {
        expect_error([&] { save_scan(path_, scan); }, ExitStatus::bad_data,
                     AllOf(HasSubstr(path_.string()), HasSubstr("bricks do not fit")));
    }
    SavedScan mirrored = some_scan();
    mirrored.T_g_c.linear().col(0) *= -1.0f;
    expect_error([&] { save_scan(path_, mirrored); }, ExitStatus::bad_data, HasSubstr("pose is none"));
    EXPECT_FALSE(std::filesystem::exists(path_));
    expect_error([] { save_scan("/nowhere/room.scan", some_scan()); }, ExitStatus::io_error,
                 HasSubstr("/nowhere/room.scan"));
}

}  // namespace
}  // namespace touchstone
