#include "platform/openni2_drivers/sequence/sequence_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

void touch(const std::filesystem::path& path) { std::ofstream(path).close(); }

TEST(SequenceFolder, NumberedFilesComeInTheOrderOfTheirNumbersWithGaps) {
    const TemporaryFolder folder;
    for (const char* name : {"frame-000012.depth.png", "frame-000003.depth.png", "frame-1000000.depth.png",
                             "frame-000003.color.jpg", "frame-000012.color.png", "frame-000012.pose.txt"}) {
        touch(folder / name);
    }
    const SequenceFolder list = list_sequence(folder.path());
    ASSERT_EQ(list.entries.size(), 3U);
    EXPECT_EQ(list.entries[0].index, 3);
    EXPECT_EQ(list.entries[0].timestamp_us, 100'000U);
    EXPECT_EQ(list.entries[0].depth, folder / "frame-000003.depth.png");
    EXPECT_EQ(list.entries[0].color, folder / "frame-000003.color.jpg");
    EXPECT_TRUE(list.entries[0].pose.empty());
    EXPECT_EQ(list.entries[1].index, 12);
    EXPECT_EQ(list.entries[1].timestamp_us, 400'000U);
    EXPECT_EQ(list.entries[1].color, folder / "frame-000012.color.png");
    EXPECT_EQ(list.entries[1].pose, folder / "frame-000012.pose.txt");
    EXPECT_EQ(list.entries[2].index, 1'000'000);
    EXPECT_TRUE(list.entries[2].color.empty());
    EXPECT_EQ(list.units_per_mm, 1);
    EXPECT_TRUE(list.intrinsics.empty());
}

TEST(SequenceFolder, OtherFilesAndColorWithoutDepthAreNoFrames) {
    const TemporaryFolder folder;
    for (const char* name :
         {"frame-000001.depth.png", "frame-000002.color.jpg", "frame-12.depth.png", "frame-00000x.depth.png",
          "frame-000003.depth.png.bak", "README.md", "depth_times.txt", "camera-intrinsics.txt"}) {
        touch(folder / name);
    }
    const SequenceFolder list = list_sequence(folder.path());
    ASSERT_EQ(list.entries.size(), 1U);
    EXPECT_EQ(list.entries[0].index, 1);
    EXPECT_EQ(list.intrinsics, folder / "camera-intrinsics.txt");
}

TEST(SequenceFolder, TumListsArePairedWithinTwentyMilliseconds) {
    const TemporaryFolder folder;
    std::ofstream(folder / "depth.txt")
        << "# depth maps\n1305031229.528784 depth/a.png\n\n"
           "1305031229.564442 depth/b.png  # note\n1305031229.700000 depth/c.png\n";
    std::ofstream(folder / "rgb.txt") << "1305031229.530000 rgb/1.jpg\n1305031229.566000 rgb/2.jpg\n"
                                         "1305031229.720001 rgb/3.jpg\n";
    const SequenceFolder list = list_sequence(folder.path());
    ASSERT_EQ(list.entries.size(), 3U);
    EXPECT_EQ(list.units_per_mm, 5);
    EXPECT_EQ(list.entries[0].index, 0);
    EXPECT_EQ(list.entries[0].timestamp_us, 1305031229528784U);
    EXPECT_EQ(list.entries[0].depth, folder / "depth/a.png");
    EXPECT_EQ(list.entries[0].color, folder / "rgb/1.jpg");
    EXPECT_EQ(list.entries[1].color, folder / "rgb/2.jpg");
    EXPECT_TRUE(list.entries[2].color.empty()) << "20.001 ms away is too far";
}

TEST(SequenceFolder, TumWithoutColor) {
    const TemporaryFolder folder;
    std::ofstream(folder / "depth.txt") << "0.5 depth/a.png\n";
    const SequenceFolder list = list_sequence(folder.path());
    ASSERT_EQ(list.entries.size(), 1U);
    EXPECT_EQ(list.entries[0].timestamp_us, 500'000U);
    EXPECT_TRUE(list.entries[0].color.empty());
}

TEST(SequenceFolder, MissingAndEmptyFoldersAreNoInput) {
    const TemporaryFolder folder;
    expect_error([&] { list_sequence(folder / "none"); }, ExitStatus::no_input, HasSubstr("none"));
    expect_error([&] { list_sequence(folder.path()); }, ExitStatus::no_input,
                 HasSubstr(folder.path().string()));
    std::ofstream(folder / "depth.txt") << "# nothing\n";
    expect_error([&] { list_sequence(folder.path()); }, ExitStatus::no_input,
                 HasSubstr(folder.path().string()));
}

TEST(SequenceFolder, AMalformedListIsBadDataWithItsLine) {
    const TemporaryFolder folder;
    std::ofstream(folder / "depth.txt") << "0.5 depth/a.png\nhello\n";
    expect_error([&] { list_sequence(folder.path()); }, ExitStatus::bad_data, HasSubstr("depth.txt:2"));
}

}  // namespace
}  // namespace touchstone
