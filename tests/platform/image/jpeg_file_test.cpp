#include "platform/image/jpeg_file.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

std::filesystem::path known_jpeg() {
    return std::filesystem::path(TOUCHSTONE_SHARED_DIR) / "data/openni-desk/color-0.jpg";
}

TEST(JpegFile, ReadsRgb) {
    if (!std::filesystem::exists(known_jpeg())) GTEST_SKIP() << "no " << known_jpeg();
    const Image8 image = read_jpeg_rgb(known_jpeg());
    EXPECT_EQ(image.width_px, 640);
    EXPECT_EQ(image.height_px, 480);
    EXPECT_EQ(image.channels, 3);
    ASSERT_EQ(image.pixels.size(), 640U * 480U * 3U);
    const auto [low, high] = std::minmax_element(image.pixels.begin(), image.pixels.end());
    EXPECT_GT(*high - *low, 100) << "a real picture has contrast";
}

TEST(JpegFile, ACutFileIsBadData) {
    if (!std::filesystem::exists(known_jpeg())) GTEST_SKIP() << "no " << known_jpeg();
    const TemporaryFolder folder;
    std::filesystem::copy_file(known_jpeg(), folder / "cut.jpg");
    std::filesystem::permissions(folder / "cut.jpg", std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add);
    std::filesystem::resize_file(folder / "cut.jpg", std::filesystem::file_size(known_jpeg()) / 2);
    expect_error([&] { read_jpeg_rgb(folder / "cut.jpg"); }, ExitStatus::bad_data, HasSubstr("cut.jpg"));
}

/// Before memory is taken for it.
TEST(JpegFile, AHeaderThatClaimsMoreThanTheFileCanHold) {
    const TemporaryFolder folder;
    // The start of a gray picture of 9000x9000, baseline, and nothing else.
    const std::string start("\xff\xd8\xff\xc0\x00\x0b\x08\x23\x28\x23\x28\x01\x01\x11\x00", 15);
    const std::string scan("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00", 10);
    std::ofstream(folder / "a.jpg", std::ios::binary) << start << scan << "pixels";
    expect_error([&] { read_jpeg_rgb(folder / "a.jpg"); }, ExitStatus::bad_data,
                 HasSubstr("claims more pixels"));
}

TEST(JpegFile, OtherFilesAreBadDataAndMissingOnesNoInput) {
    const TemporaryFolder folder;
    std::ofstream(folder / "text.jpg") << "this is no picture";
    expect_error([&] { read_jpeg_rgb(folder / "text.jpg"); }, ExitStatus::bad_data, HasSubstr("text.jpg"));
    expect_error([&] { read_jpeg_rgb(folder / "none.jpg"); }, ExitStatus::no_input, HasSubstr("none.jpg"));
}

}  // namespace
}  // namespace touchstone
