#include "platform/system/projected_picture.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <thread>

#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

/// Of this test alone: tests run side by side.
std::string own_name() {
    return projected_picture_name() + "-" + testing::UnitTest::GetInstance()->current_test_info()->name();
}

std::vector<std::uint8_t> uniform(int width_px, int height_px, std::uint8_t value) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width_px * height_px), value);
}

TEST(ProjectedPicture, TheNameIsOfThisProcess) {
    EXPECT_EQ(projected_picture_name().front(), '/');
    EXPECT_EQ(projected_picture_name(), projected_picture_name());
    EXPECT_NE(projected_picture_name().find(std::to_string(getpid())), std::string::npos);
}

TEST(ProjectedPicture, ThereIsNothingBeforeTheFirst) {
    ProjectedPictureReader reader(own_name());
    EXPECT_EQ(reader.latest(), nullptr) << "no writer";
    ProjectedPictureWriter writer(own_name(), 8, 6);
    EXPECT_EQ(reader.latest(), nullptr) << "a writer, no picture";
    writer.show(uniform(8, 6, 7), 8, 6);
    EXPECT_NE(reader.latest(), nullptr);
}

TEST(ProjectedPicture, ComesAcrossAsItWasShown) {
    ProjectedPictureWriter writer(own_name(), 9, 6);
    ProjectedPictureReader reader(own_name());
    std::vector<std::uint8_t> rgba(4 * 5 * 3);
    for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(3 * i);
    writer.show(rgba, 5, 3);
    const ProjectedPicture* picture = reader.latest();
    ASSERT_NE(picture, nullptr);
    EXPECT_EQ(picture->width_px, 5);
    EXPECT_EQ(picture->height_px, 3);
    EXPECT_EQ(picture->rgba, rgba);
    EXPECT_FALSE(picture->aim_px);
    EXPECT_GT(picture->version, 0U);
}

TEST(ProjectedPicture, TheVersionGrowsWithEveryPictureAndOnlyThen) {
    ProjectedPictureWriter writer(own_name(), 4, 4);
    ProjectedPictureReader reader(own_name());
    writer.show(uniform(4, 4, 1), 4, 4);
    const std::uint64_t first = reader.latest()->version;
    EXPECT_EQ(reader.latest()->version, first);
    writer.show(uniform(4, 4, 1), 4, 4);
    EXPECT_GT(reader.latest()->version, first);
}

TEST(ProjectedPicture, TheAimComesAndGoes) {
    ProjectedPictureWriter writer(own_name(), 4, 4);
    ProjectedPictureReader reader(own_name());
    writer.show(uniform(4, 4, 1), 4, 4, std::array{1.25F, -3.5F});
    ASSERT_TRUE(reader.latest()->aim_px);
    EXPECT_EQ(*reader.latest()->aim_px, (std::array{1.25F, -3.5F}));
    writer.show(uniform(4, 4, 1), 4, 4);
    EXPECT_FALSE(reader.latest()->aim_px);
}

TEST(ProjectedPicture, RefusesWhatItHasNoRoomFor) {
    ProjectedPictureWriter writer(own_name(), 4, 3);
    expect_error([&] { writer.show(uniform(5, 2, 0), 5, 2); }, ExitStatus::bad_data,
                 testing::AllOf(HasSubstr("5x2"), HasSubstr("4x3")));
    expect_error([&] { writer.show(uniform(2, 2, 0), 4, 3); }, ExitStatus::bad_data, HasSubstr("16 bytes"));
    expect_error([] { ProjectedPictureWriter("/no/such/name", 4, 3); }, ExitStatus::io_error,
                 HasSubstr("/no/such/name"));
    ProjectedPictureReader reader(own_name());
    EXPECT_EQ(reader.latest(), nullptr);
}

TEST(ProjectedPicture, TheWriterMayGoAndComeBackWithAnotherSize) {
    ProjectedPictureReader reader(own_name());
    std::uint64_t version = 0;
    for (const int size : {4, 900, 2}) {
        ProjectedPictureWriter writer(own_name(), size, size);
        EXPECT_EQ(reader.latest(), nullptr) << "the old one is not shown for the new";
        writer.show(uniform(size, size, static_cast<std::uint8_t>(size)), size, size);
        const ProjectedPicture* picture = reader.latest();
        ASSERT_NE(picture, nullptr);
        EXPECT_EQ(picture->rgba, uniform(size, size, static_cast<std::uint8_t>(size)));
        EXPECT_GT(picture->version, version);
        version = picture->version;
    }
    EXPECT_EQ(reader.latest(), nullptr) << "the writer has taken its picture with it";
}

TEST(ProjectedPicture, AWriterThatIsReplacedLeavesTheNewOneAlone) {
    ProjectedPictureReader reader(own_name());
    auto first = std::make_unique<ProjectedPictureWriter>(own_name(), 4, 4);
    ProjectedPictureWriter second(own_name(), 4, 4);
    second.show(uniform(4, 4, 2), 4, 4);
    first.reset();
    ASSERT_NE(reader.latest(), nullptr);
    EXPECT_EQ(reader.latest()->rgba[0], 2);
}

TEST(ProjectedPicture, IsNeverTorn) {
    constexpr int width = 320, height = 200, pictures = 2000;
    const std::string name = own_name();
    ProjectedPictureWriter writer(name, width, height);
    ProjectedPictureReader reader(name);
    std::atomic<bool> ended = false;
    std::thread showing([&] {
        for (int i = 1; i <= pictures; ++i) {
            const auto value = static_cast<std::uint8_t>(i % 251);
            // Two sizes and an aim, so that these would be seen to belong to another picture.
            const int rows = value % 2 == 0 ? height : height / 2;
            writer.show(uniform(width, rows, value), width, rows,
                        std::array{static_cast<float>(value), 0.0F});
        }
        ended = true;
    });
    int torn = 0;
    while (!ended) {
        const ProjectedPicture* picture = reader.latest();
        if (picture == nullptr) continue;
        const std::uint8_t value = picture->rgba[0];
        torn += picture->height_px != (value % 2 == 0 ? height : height / 2);
        torn += picture->rgba != uniform(width, picture->height_px, value);
        torn += *picture->aim_px != std::array{static_cast<float>(value), 0.0F};
    }
    showing.join();
    EXPECT_EQ(torn, 0);
    EXPECT_EQ(reader.latest()->rgba[0], pictures % 251);
}

}  // namespace
}  // namespace touchstone
