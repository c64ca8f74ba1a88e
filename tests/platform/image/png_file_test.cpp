#include "platform/image/png_file.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

Image16 ramp_16(int width_px, int height_px) {
    Image16 image{width_px, height_px, {}};
    for (int i = 0; i < width_px * height_px; ++i)
        image.pixels.push_back(static_cast<std::uint16_t>(i * 257 + 3));
    return image;
}

Image8 ramp_8(int width_px, int height_px, int channels) {
    Image8 image{width_px, height_px, channels, {}};
    for (int i = 0; i < width_px * height_px * channels; ++i)
        image.pixels.push_back(static_cast<std::uint8_t>(i * 7));
    return image;
}

void cut(const std::filesystem::path& path) {
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
}

TEST(PngFile, SixteenBitComesBackExactly) {
    const TemporaryFolder folder;
    const Image16 image = ramp_16(37, 11);
    write_png(folder / "a.png", image);
    const Image16 back = read_png_16(folder / "a.png");
    EXPECT_EQ(back.width_px, 37);
    EXPECT_EQ(back.height_px, 11);
    EXPECT_EQ(back.pixels, image.pixels);
}

TEST(PngFile, EightBitComesBackExactlyInEachKind) {
    const TemporaryFolder folder;
    for (const int channels : {1, 3, 4}) {
        const Image8 image = ramp_8(19, 23, channels);
        write_png(folder / "a.png", image);
        const Image8 back = read_png_8(folder / "a.png");
        EXPECT_EQ(back.width_px, 19);
        EXPECT_EQ(back.height_px, 23);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.pixels, image.pixels);
    }
}

TEST(PngFile, SixteenBitIsBigEndianInTheFileAsTheStandardSays) {
    const std::filesystem::path known =
        std::filesystem::path(TOUCHSTONE_SHARED_DIR) / "data/openni-desk/depth-0.png";
    if (!std::filesystem::exists(known)) GTEST_SKIP() << "no " << known;
    const Image16 image = read_png_16(known);
    EXPECT_EQ(image.width_px, 640);
    EXPECT_EQ(image.height_px, 480);
    // A swapped reader would give values all over the range; the recording's valid depths are 488 to 2153 mm.
    for (const auto depth : image.pixels) ASSERT_TRUE(depth == 0 || (depth >= 488 && depth <= 2153)) << depth;
}

TEST(PngFile, MissingFileIsNoInput) {
    const TemporaryFolder folder;
    expect_error([&] { read_png_16(folder / "none.png"); }, ExitStatus::no_input, HasSubstr("none.png"));
    expect_error([&] { read_png_8(folder / "none.png"); }, ExitStatus::no_input, HasSubstr("none.png"));
}

TEST(PngFile, DamagedFilesAreBadDataAndNamed) {
    const TemporaryFolder folder;
    write_png(folder / "cut.png", ramp_16(64, 64));
    cut(folder / "cut.png");
    expect_error([&] { read_png_16(folder / "cut.png"); }, ExitStatus::bad_data, HasSubstr("cut.png"));
    std::ofstream(folder / "text.png") << "this is no picture";
    expect_error([&] { read_png_16(folder / "text.png"); }, ExitStatus::bad_data, HasSubstr("text.png"));
    expect_error([&] { read_png_8(folder / "text.png"); }, ExitStatus::bad_data, HasSubstr("text.png"));
    std::ofstream(folder / "empty.png").close();
    expect_error([&] { read_png_8(folder / "empty.png"); }, ExitStatus::bad_data, HasSubstr("empty.png"));
}

TEST(PngFile, AFlippedByteIsNoticed) {
    const TemporaryFolder folder;
    write_png(folder / "a.png", ramp_16(64, 64));
    const auto size = static_cast<std::streamoff>(std::filesystem::file_size(folder / "a.png"));
    std::fstream file(folder / "a.png", std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(size / 2);
    const char byte = static_cast<char>(file.get() ^ 0x55);
    file.seekp(size / 2);
    file.put(byte);
    file.close();
    expect_error([&] { read_png_16(folder / "a.png"); }, ExitStatus::bad_data, HasSubstr("a.png"));
}

TEST(PngFile, TheWrongKindIsBadData) {
    const TemporaryFolder folder;
    write_png(folder / "gray8.png", ramp_8(4, 4, 1));
    write_png(folder / "gray16.png", ramp_16(4, 4));
    expect_error([&] { read_png_16(folder / "gray8.png"); }, ExitStatus::bad_data, HasSubstr("8 bit"));
    expect_error([&] { read_png_8(folder / "gray16.png"); }, ExitStatus::bad_data, HasSubstr("16 bit"));
}

TEST(PngFile, UnwritableFileIsIoError) {
    expect_error([&] { write_png("/nonexistent/a.png", ramp_16(2, 2)); }, ExitStatus::io_error,
                 HasSubstr("a.png"));
    expect_error([&] { write_png("/dev/full", ramp_16(640, 480)); }, ExitStatus::io_error,
                 HasSubstr("/dev/full"));
    expect_error([&] { write_png("/dev/full", ramp_16(2, 2)); }, ExitStatus::io_error,
                 HasSubstr("/dev/full"));
}

/// Before memory is taken for it.
TEST(PngFile, AHeaderThatClaimsMoreThanTheFileCanHold) {
    const TemporaryFolder folder;
    write_png(folder / "a.png", Image8{64, 64, 1, std::vector<std::uint8_t>(64 * 64)});
    std::fstream file(folder / "a.png", std::ios::in | std::ios::out | std::ios::binary);
    // 8000x8000, with the checksum that belongs to it.
    file.seekp(16);
    file.write("\x00\x00\x1f\x40\x00\x00\x1f\x40", 8);
    file.seekp(29);
    file.write("\x23\x9a\xf2\x28", 4);
    file.close();
    expect_error([&] { read_png_8(folder / "a.png"); }, ExitStatus::bad_data,
                 HasSubstr("claims more pixels"));
}

TEST(PngFile, PixelsThatDoNotFitAreAProgrammingError) {
    const TemporaryFolder folder;
    Image16 image = ramp_16(4, 4);
    image.pixels.pop_back();
    EXPECT_THROW(write_png(folder / "a.png", image), std::invalid_argument);
    EXPECT_THROW(write_png(folder / "a.png", Image8{4, 4, 2, std::vector<std::uint8_t>(32)}),
                 std::invalid_argument);
    EXPECT_THROW(write_png(folder / "a.png", Image16{}), std::invalid_argument);
}

}  // namespace
}  // namespace touchstone
