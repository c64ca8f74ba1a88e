#include "app/photo_folder.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "platform/image/png_file.hpp"

namespace touchstone {
namespace {

Image8 plain(int width_px, int height_px, const std::vector<std::uint8_t>& pixel) {
    Image8 image{width_px, height_px, static_cast<int>(pixel.size()), {}};
    image.pixels.resize(static_cast<std::size_t>(width_px * height_px) * pixel.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = pixel[i % pixel.size()];
    return image;
}

class PhotoFolder : public testing::Test {
  protected:
    PhotoFolder()
        : folder_(std::filesystem::temp_directory_path() / ("touchstone_photos" + std::to_string(getpid()))) {
        std::filesystem::create_directory(folder_);
    }
    ~PhotoFolder() override { std::filesystem::remove_all(folder_); }

    std::vector<Picture> all() const {
        std::vector<Picture> pictures;
        const PictureStream stream = open_photo_folder(folder_);
        while (std::optional<Picture> picture = stream.next()) pictures.push_back(*picture);
        return pictures;
    }
    std::filesystem::path folder_;
};

TEST_F(PhotoFolder, GivesThePicturesByName) {
    write_png(folder_ / "b.png", plain(4, 3, {200}));
    write_png(folder_ / "a.PNG", plain(5, 3, {10, 20, 30}));
    std::ofstream(folder_ / "notes.txt") << "no picture";
    const auto pictures = all();
    ASSERT_EQ(pictures.size(), 2U);
    EXPECT_EQ(pictures[0].width_px, 5);
    EXPECT_EQ(pictures[0].rgba[2], 30);
    EXPECT_EQ(pictures[1].rgba[1], 200);
}

TEST_F(PhotoFolder, LeavesOutWhatCannotBeRead) {
    std::ofstream(folder_ / "a.jpg") << "not a JPEG";
    std::ofstream(folder_ / "b.png") << "";
    write_png(folder_ / "c.png", plain(2, 2, {7}));
    ASSERT_EQ(all().size(), 1U);
    EXPECT_EQ(all()[0].rgba[0], 7);
}

TEST_F(PhotoFolder, AFolderWithoutPicturesIsSaid) {
    std::ofstream(folder_ / "notes.txt") << "no picture";
    testing::internal::CaptureStderr();
    EXPECT_FALSE(open_photo_folder(folder_).next());
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                testing::HasSubstr("no PNG or JPEG in " + folder_.string()));
}

TEST_F(PhotoFolder, AMissingFolderGivesNone) { EXPECT_FALSE(open_photo_folder(folder_ / "missing").next()); }

TEST_F(PhotoFolder, MoreThanTheMostAreLeftOut) {
    for (int i = 0; i < 30; ++i)
        write_png(folder_ / (std::to_string(100 + i).append(".png")), plain(1, 1, {1}));
    EXPECT_EQ(all().size(), most_photos);
}

TEST(ToPhoto, KeepsSmallOnesAndMeansLargeOnes) {
    EXPECT_EQ(to_photo(plain(30, 20, {1, 2, 3}), 40).width_px, 30);
    Image8 checkers = plain(400, 200, {0});
    for (std::size_t i = 0; i < checkers.pixels.size(); ++i)
        checkers.pixels[i] = (i % 400 + i / 400) % 2 == 0 ? 0 : 200;
    const Picture photo = to_photo(checkers, 100);
    EXPECT_EQ(photo.width_px, 100);
    EXPECT_EQ(photo.height_px, 50);
    for (std::size_t i = 0; i < photo.rgba.size(); ++i) EXPECT_EQ(photo.rgba[i], i % 4 == 3 ? 255 : 100);
}

TEST(ToPhoto, ALongOneKeepsItsShapeAndAtLeastAPixel) {
    const Picture photo = to_photo(plain(5000, 2, {9, 9, 9}), 100);
    EXPECT_EQ(photo.width_px, 100);
    EXPECT_EQ(photo.height_px, 1);
}

TEST(ToPhoto, WhatIsTransparentIsWhite) {
    EXPECT_EQ(to_photo(plain(1, 1, {0, 0, 0, 0}), 10).rgba[0], 255);
    EXPECT_NEAR(to_photo(plain(1, 1, {0, 0, 0, 128}), 10).rgba[0], 127, 1);
}

}  // namespace
}  // namespace touchstone
