#include "pipeline/height_minima.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

constexpr int width_px = 40, height_px = 30;

struct Heights {
    std::vector<float> height_m = std::vector<float>(width_px * height_px, 0.1f);
    std::vector<std::uint8_t> member = std::vector<std::uint8_t>(width_px * height_px, 1);

    /// A pit of 3 mm a pixel.
    void dig(int x, int y, float bottom_m) {
        for (int j = 0; j < height_px; ++j) {
            for (int i = 0; i < width_px; ++i) {
                const float far_px = std::hypot(static_cast<float>(i - x), static_cast<float>(j - y));
                float& h = height_m[static_cast<std::size_t>(j * width_px + i)];
                h = std::min(h, bottom_m + 0.003f * far_px);
            }
        }
    }
    std::vector<int> minima(const HeightMinimaConfig& config = {}) const {
        std::vector<int> indices;
        for (const HeightMinimum& m : find_height_minima(height_m, member, width_px, config).minima)
            indices.push_back(m.index);
        return indices;
    }
};

TEST(HeightMinima, TwoPitsAreTwoMinima) {
    Heights heights;
    heights.dig(8, 10, 0.010f);
    heights.dig(28, 15, 0.020f);
    EXPECT_THAT(heights.minima(), testing::UnorderedElementsAre(10 * width_px + 8, 15 * width_px + 28));
}

TEST(HeightMinima, APitThatDoesNotStandOutIsNone) {
    Heights heights;
    heights.dig(8, 10, 0.010f);
    heights.dig(12, 10, 0.012f);  // the saddle between them is 4 mm above it
    EXPECT_THAT(heights.minima(), testing::ElementsAre(10 * width_px + 8));
}

TEST(HeightMinima, HighOnesAndSmallOnesAreLeftOut) {
    Heights heights;
    std::ranges::fill(heights.height_m, 0.3f);
    EXPECT_TRUE(heights.minima().empty());
    heights.height_m[200] = 0.01f;
    heights.member.assign(heights.member.size(), 0);
    for (int i = 0; i < 5; ++i) heights.member[static_cast<std::size_t>(200 + i)] = 1;
    EXPECT_TRUE(heights.minima().empty());
}

TEST(HeightMinima, PartsWithoutContactAreTwoObjects) {
    Heights heights;
    heights.dig(8, 10, 0.010f);
    heights.dig(28, 10, 0.010f);
    for (int y = 0; y < height_px; ++y) heights.member[static_cast<std::size_t>(y * width_px + 18)] = 0;
    const HeightMinima found = find_height_minima(heights.height_m, heights.member, width_px, {});
    ASSERT_EQ(found.minima.size(), 2u);
    EXPECT_NE(found.minima[0].object, found.minima[1].object);
    EXPECT_THAT(found.object_pixels, testing::UnorderedElementsAre(18 * height_px, 21 * height_px));
}

/// Two low places with rows 10 to 13, and a high row of pixels in the columns between them, 11 of them.
HeightMinima joined_by_high_row(int y) {
    Heights heights;
    heights.member.assign(heights.member.size(), 0);
    const auto put = [&](int i, int j, float height_m) {
        const auto at = static_cast<std::size_t>(j * width_px + i);
        heights.member[at] = 1;
        heights.height_m[at] = height_m;
    };
    for (int j = 10; j < 14; ++j)
        for (const int i : {5, 6, 7, 8, 20, 21, 22, 23}) put(i, j, 0.01f);
    for (int i = 9; i < 20; ++i) put(i, y, 0.3f);
    return find_height_minima(heights.height_m, heights.member, width_px, {});
}

TEST(HeightMinima, HighPixelsJoinWhatTheyTouchBesideAboveAndBelow) {
    for (const int y : {9, 10, 12, 13, 14}) {
        const HeightMinima found = joined_by_high_row(y);
        EXPECT_EQ(found.minima.size(), 2u) << y;
        EXPECT_THAT(found.object_pixels, testing::ElementsAre(2 * 16 + 11)) << y;
    }
    EXPECT_THAT(joined_by_high_row(8).object_pixels, testing::UnorderedElementsAre(16, 16, 11));
    EXPECT_THAT(joined_by_high_row(15).object_pixels, testing::UnorderedElementsAre(16, 16, 11));
}

TEST(HeightMinima, RowsOfHighPixelsAreOneObject) {
    Heights heights;
    std::ranges::fill(heights.height_m, 0.3f);
    heights.member[0] = 0;
    EXPECT_THAT(find_height_minima(heights.height_m, heights.member, width_px, {}).object_pixels,
                testing::ElementsAre(width_px * height_px - 1));
}

TEST(HeightMinima, RowsDoNotTouchAcrossThePicturesBorder) {
    Heights heights;
    heights.member.assign(heights.member.size(), 0);
    for (int y = 0; y < height_px; ++y) {
        heights.member[static_cast<std::size_t>(y * width_px)] = 1;
        heights.member[static_cast<std::size_t>(y * width_px + width_px - 1)] = 1;
    }
    EXPECT_EQ(find_height_minima(heights.height_m, heights.member, width_px, {}).object_pixels.size(), 2u);
}

TEST(HeightMinima, NothingInAnEmptyPicture) {
    Heights heights;
    heights.member.assign(heights.member.size(), 0);
    EXPECT_TRUE(heights.minima().empty());
    EXPECT_TRUE(find_height_minima({}, {}, 1, {}).minima.empty());
}

}  // namespace
}  // namespace touchstone
