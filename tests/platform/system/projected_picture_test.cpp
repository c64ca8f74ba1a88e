#include "platform/system/projected_picture.hpp"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

std::string name_for(const char* test) { return projected_picture_name() + "-" + test; }

std::vector<std::uint8_t> filled(int width_px, int height_px, int value) {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width_px * height_px),
                                     static_cast<std::uint8_t>(value));
}

TEST(ProjectedPicture, IsSeenAsItWasShown) {
    const std::string name = name_for("round");
    ProjectedPictureReader reader(name);
    EXPECT_EQ(reader.latest(), nullptr) << "no writer";
    ProjectedPictureWriter writer(name, 8, 4);
    EXPECT_EQ(reader.latest(), nullptr) << "no picture";
    std::vector<std::uint8_t> rgba(128);
    for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(i);
    writer.show(rgba, 8, 4, std::array{3.5F, 2.25F});
    const ProjectedPicture* seen = reader.latest();
    ASSERT_NE(seen, nullptr);
    EXPECT_EQ(seen->width_px, 8);
    EXPECT_EQ(seen->height_px, 4);
    EXPECT_EQ(seen->rgba, rgba);
    EXPECT_EQ(seen->aim_px, (std::array{3.5F, 2.25F}));
    const std::uint64_t version = seen->version;
    writer.show(filled(4, 2, 9), 4, 2);
    seen = reader.latest();
    EXPECT_GT(seen->version, version);
    EXPECT_EQ(seen->rgba, filled(4, 2, 9));
    EXPECT_FALSE(seen->aim_px);
}

TEST(ProjectedPicture, ALargerOneIsRefused) {
    ProjectedPictureWriter writer(name_for("large"), 8, 4);
    EXPECT_THROW(writer.show(filled(9, 4, 1), 9, 4), Error);
    EXPECT_THROW(writer.show(filled(4, 4, 1), 8, 4), Error) << "fewer pixels than said";
}

TEST(ProjectedPicture, AnotherWriterIsFound) {
    const std::string name = name_for("again");
    ProjectedPictureReader reader(name);
    {
        ProjectedPictureWriter writer(name, 8, 4);
        writer.show(filled(8, 4, 1), 8, 4);
        ASSERT_NE(reader.latest(), nullptr);
    }
    EXPECT_EQ(reader.latest(), nullptr) << "it throws nothing any more";
    ProjectedPictureWriter writer(name, 16, 9);
    writer.show(filled(16, 9, 2), 16, 9);
    ASSERT_NE(reader.latest(), nullptr);
    EXPECT_EQ(reader.latest()->rgba, filled(16, 9, 2));
}

TEST(ProjectedPicture, IsNeverHalfOfOneAndHalfOfTheNext) {
    const std::string name = name_for("torn");
    ProjectedPictureWriter writer(name, 64, 64);
    std::atomic<bool> ends = false;
    std::thread writing([&] {
        for (int i = 1; !ends; ++i) writer.show(filled(64, 64, i % 256), 64, 64);
    });
    ProjectedPictureReader reader(name);
    int seen = 0;
    for (int look = 0; look < 20000; ++look) {
        const ProjectedPicture* picture = reader.latest();
        if (!picture) continue;
        ++seen;
        const auto [least, most] = std::ranges::minmax(picture->rgba);
        ASSERT_EQ(least, most);
    }
    ends = true;
    writing.join();
    EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace touchstone
