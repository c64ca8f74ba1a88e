#include "platform/openni2_drivers/sequence/sequence_source.hpp"

#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>

#include "platform/image/png_file.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string depth_name(int index) { return fmt::format("frame-{:06d}.depth.png", index); }
std::string color_name(int index) { return fmt::format("frame-{:06d}.color.png", index); }

Image16 depth_picture(int width_px, int height_px, std::uint16_t value) {
    return {width_px, height_px,
            std::vector<std::uint16_t>(
                static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), value)};
}

TEST(SequenceSource, ReplaysNumberedFrames) {
    const TemporaryFolder folder;
    write_png(folder / depth_name(5), Image16{2, 2, {0, 65535, 1000, 65534}});
    write_png(folder / depth_name(7), depth_picture(2, 2, 1234));
    std::ofstream(folder / "camera-intrinsics.txt") << "585 0 320\n0 585 240\n0 0 1\n";
    SequenceSource source(folder.path());
    EXPECT_EQ(source.info().default_pace, Pace::step);
    EXPECT_EQ(source.info().intrinsics.width_px, 2);
    EXPECT_FLOAT_EQ(source.info().intrinsics.fx_px, 585);
    EXPECT_FALSE(source.info().has_color);
    SourceFrame frame;
    ASSERT_TRUE(source.next(frame));
    EXPECT_EQ(frame.index, 5);
    EXPECT_EQ(frame.timestamp_us, 166'666U);
    EXPECT_THAT(frame.depth_mm, ElementsAre(0, 0, 1000, 65534)) << "65535 is invalid";
    ASSERT_TRUE(source.next(frame));
    EXPECT_EQ(frame.index, 7);
    EXPECT_FALSE(source.next(frame));
    EXPECT_FALSE(source.next(frame));
}

TEST(SequenceSource, WithoutIntrinsicsTheKinectsAreScaledToThePicture) {
    const TemporaryFolder folder;
    write_png(folder / depth_name(0), depth_picture(320, 240, 1));
    EXPECT_FLOAT_EQ(SequenceSource(folder.path()).info().intrinsics.fx_px, 287.9F);
}

TEST(SequenceSource, ColorOfAnySizeAndKindComesAsRgbWhenItIsWanted) {
    const TemporaryFolder folder;
    for (const int index : {0, 1, 2}) write_png(folder / depth_name(index), depth_picture(2, 2, 9));
    write_png(folder / color_name(0), Image8{1, 2, 4, {1, 2, 3, 255, 4, 5, 6, 255}});
    write_png(folder / color_name(2), Image8{1, 2, 1, {7, 8}});
    SequenceSource source(folder.path());
    EXPECT_TRUE(source.info().has_color);
    EXPECT_EQ(source.info().color_width_px, 1);
    EXPECT_EQ(source.info().color_height_px, 2);
    SourceFrame frame;
    source.enable_color(true);
    ASSERT_TRUE(source.next(frame));
    EXPECT_THAT(frame.color_rgb, ElementsAre(1, 2, 3, 4, 5, 6));
    ASSERT_TRUE(source.next(frame));
    EXPECT_TRUE(frame.color_rgb.empty()) << "frame 1 has no colour";
    ASSERT_TRUE(source.next(frame));
    EXPECT_THAT(frame.color_rgb, ElementsAre(7, 7, 7, 8, 8, 8));
    SequenceSource depth_only(folder.path());
    ASSERT_TRUE(depth_only.next(frame));
    EXPECT_TRUE(frame.color_rgb.empty());
}

TEST(SequenceSource, TumDepthIsFifthsOfAMillimetreRounded) {
    const TemporaryFolder folder;
    write_png(folder / "a.png", Image16{3, 2, {0, 2, 3, 5002, 5003, 65535}});
    std::ofstream(folder / "depth.txt") << "10.25 a.png\n";
    SequenceSource source(folder.path());
    SourceFrame frame;
    ASSERT_TRUE(source.next(frame));
    EXPECT_EQ(frame.timestamp_us, 10'250'000U);
    EXPECT_THAT(frame.depth_mm, ElementsAre(0, 0, 1, 1000, 1001, 0));
}

TEST(SequenceSource, BadPicturesAreBadDataAndNamed) {
    const TemporaryFolder folder;
    write_png(folder / depth_name(0), depth_picture(4, 4, 1));
    write_png(folder / depth_name(1), depth_picture(4, 5, 1));
    SequenceSource source(folder.path());
    SourceFrame frame;
    ASSERT_TRUE(source.next(frame));
    expect_error([&] { source.next(frame); }, ExitStatus::bad_data,
                 AllOf(HasSubstr(depth_name(1)), HasSubstr("4x5"), HasSubstr("4x4")));
    std::ofstream(folder / depth_name(0)) << "no picture";
    expect_error([&] { SequenceSource(folder.path()); }, ExitStatus::bad_data, HasSubstr(depth_name(0)));
    write_png(folder / depth_name(0), Image8{4, 4, 1, std::vector<std::uint8_t>(16)});
    expect_error([&] { SequenceSource(folder.path()); }, ExitStatus::bad_data, HasSubstr("8 bit"));
    write_png(folder / depth_name(0), depth_picture(4097, 1, 1));
    expect_error([&] { SequenceSource(folder.path()); }, ExitStatus::bad_data, HasSubstr("4097x1"));
}

TEST(SequenceSource, TheLargestPictureIsRead) {
    const TemporaryFolder folder;
    write_png(folder / depth_name(0), depth_picture(4096, 4096, 777));
    SequenceSource source(folder.path());
    SourceFrame frame;
    ASSERT_TRUE(source.next(frame));
    ASSERT_EQ(frame.depth_mm.size(), 4096U * 4096U);
    EXPECT_EQ(frame.depth_mm.back(), 777);
}

TEST(SequenceSource, AListedPictureThatIsMissingIsNoInput) {
    const TemporaryFolder folder;
    std::ofstream(folder / "depth.txt") << "1 gone.png\n";
    expect_error([&] { SequenceSource(folder.path()); }, ExitStatus::no_input, HasSubstr("gone.png"));
}

}  // namespace
}  // namespace touchstone
