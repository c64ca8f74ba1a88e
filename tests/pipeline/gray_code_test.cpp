#include "pipeline/gray_code.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr GrayCode code{640, 400, 8};
constexpr int width_px = 320, height_px = 240;

/// A camera over a plane: a pixel of the camera is 2 pixels of the projector wide, turned by 10 degrees.
Eigen::Vector2f lit_px(float x_px, float y_px) {
    const float turn = 0.17f;
    const float x = 2.0f * (x_px - 160.0f), y = 2.0f * (y_px - 120.0f);
    return {320.0f + std::cos(turn) * x - std::sin(turn) * y,
            200.0f + std::sin(turn) * x + std::cos(turn) * y};
}

float light(int pattern, float x_px, float y_px) {
    const Eigen::Vector2f at = lit_px(x_px, y_px);
    const int x = static_cast<int>(std::lround(at.x())), y = static_cast<int>(std::lround(at.y()));
    if (x < 0 || y < 0 || x >= code.width_px || y >= code.height_px) return 0.0f;
    return code.is_lit(pattern, x, y) ? 1.0f : 0.0f;
}

/// A surface whose left half is dark, under 60 grey levels of the room's light, with noise.
std::vector<std::vector<float>> seen_pictures() {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0.0f, 2.0f);
    std::vector<std::vector<float>> seen;
    for (int pattern = 0; pattern < code.patterns(); ++pattern) {
        std::vector<float>& picture = seen.emplace_back();
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                float sum = 0.0f;
                for (int tap = 0; tap < 9; ++tap)
                    sum += light(pattern, static_cast<float>(x) + 0.33f * static_cast<float>(tap % 3 - 1),
                                 static_cast<float>(y) + 0.33f * static_cast<float>(tap / 3 - 1));
                const float albedo = x < 160 ? 0.4f : 1.0f;
                picture.push_back(albedo * (60.0f + 120.0f * sum / 9.0f) + noise(random));
            }
        }
    }
    return seen;
}

std::vector<Eigen::Vector4f> points_on_plane() {
    std::vector<Eigen::Vector4f> points;
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x)
            points.emplace_back(0.002f * static_cast<float>(x), 0.002f * static_cast<float>(y), 1.0f, 1.0f);
    return points;
}

/// Between the middles of cells and where their points are lit.
double rms_px(const std::vector<ProjectorMatch>& matches) {
    double sum = 0.0;
    for (const ProjectorMatch& match : matches) {
        const Eigen::Vector2f at = lit_px(match.point_g_m.x() / 0.002f, match.point_g_m.y() / 0.002f);
        sum += (at - match.pixel_px).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(matches.size()));
}

TEST(GrayCode, EveryCellHasItsOwnPatterns) {
    EXPECT_EQ(code.patterns(), 2 + 2 * (7 + 6));
    std::set<std::vector<bool>> words;
    for (int row = 0; row < code.rows(); ++row) {
        for (int column = 0; column < code.columns(); ++column) {
            std::vector<bool> word;
            for (int pattern = 2; pattern < code.patterns(); pattern += 2) {
                word.push_back(code.is_lit(pattern, 8 * column + 3, 8 * row + 5));
                EXPECT_NE(word.back(), code.is_lit(pattern + 1, 8 * column + 3, 8 * row + 5));
            }
            words.insert(word);
        }
    }
    EXPECT_EQ(words.size(), static_cast<std::size_t>(code.rows() * code.columns()));
}

TEST(GrayCode, NeighboursDifferInOneBit) {
    for (int column = 0; column + 1 < code.columns(); ++column) {
        int changes = 0;
        for (int pattern = 2; pattern < code.patterns(); pattern += 2)
            changes += code.is_lit(pattern, 8 * column, 0) != code.is_lit(pattern, 8 * column + 8, 0);
        EXPECT_EQ(changes, 1) << column;
    }
}

TEST(GrayCode, DrawsWhiteBlackAndStripes) {
    const auto white = draw_pattern(code, 0), black = draw_pattern(code, 1), stripes = draw_pattern(code, 2);
    EXPECT_EQ(std::set(white.begin(), white.end()), std::set<std::uint8_t>{255});
    EXPECT_EQ(std::set(black.begin(), black.end()), std::set<std::uint8_t>{0});
    EXPECT_EQ(stripes[0], 0) << "the first bit of cell 0";
    EXPECT_EQ(stripes[639], 255) << "of the last";
}

/// Pixels that are known are right to a pixel of the projector, and most are known, dark half included.
TEST(GrayCode, DecodesWhatACameraSees) {
    const CellPicture cells = decode_cells(code, seen_pictures(), width_px, height_px);
    int known = 0, lit = 0;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const Eigen::Vector2f at = lit_px(static_cast<float>(x), static_cast<float>(y));
            if (at.x() < 2.0f || at.y() < 2.0f || at.x() > 637.0f || at.y() > 397.0f) continue;
            ++lit;
            const auto pixel = static_cast<std::size_t>(y * width_px + x);
            if (cells.column[pixel] < 0) continue;
            ++known;
            EXPECT_NEAR((static_cast<float>(cells.column[pixel]) + 0.5f) * 8.0f - 0.5f, at.x(), 5.5f);
            EXPECT_NEAR((static_cast<float>(cells.row[pixel]) + 0.5f) * 8.0f - 0.5f, at.y(), 5.5f);
        }
    }
    EXPECT_GT(known, 0.8 * lit);
    EXPECT_GE(cells.lit, lit);
}

/// Middles of cells are known to a third of a pixel of the projector (rms), from cells of eight.
TEST(GrayCode, MiddlesOfCellsAreKnownBetterThanTheirSides) {
    const CellPicture cells = decode_cells(code, seen_pictures(), width_px, height_px);
    const auto matches = match_cells(code, cells, points_on_plane());
    EXPECT_GT(matches.size(), 2000U) << "of the 3000 that are seen";
    EXPECT_LT(rms_px(matches), 0.5);
}

/// Where a stripe is hardly brighter than its inverse, nobody knows on which side of its edge the pixel lies.
TEST(GrayCode, PixelsOnAnEdgeOfAStripeAreNotGuessed) {
    auto seen = seen_pictures();
    constexpr int stripes = 6;
    const std::size_t pixel = 120 * width_px + 200;
    ASSERT_GE(decode_cells(code, seen, width_px, height_px).column[pixel], 0);
    const float middle = 0.5f * (seen[0][pixel] + seen[1][pixel]);
    seen[stripes][pixel] = middle + 2.0f;
    seen[stripes + 1][pixel] = middle - 2.0f;
    const CellPicture cells = decode_cells(code, seen, width_px, height_px);
    EXPECT_EQ(cells.column[pixel], -1);
    EXPECT_EQ(cells.row[pixel], -1);
}

/// Cells cut by an edge of the depth picture would be off by pixels.
TEST(GrayCode, CellsThatAreCutOffAreLeftOut) {
    const CellPicture cells = decode_cells(code, seen_pictures(), width_px, height_px);
    auto points = points_on_plane();
    for (int y = 0; y < height_px; ++y)
        for (int x = 150; x < 171; ++x) points[static_cast<std::size_t>(y * width_px + x)].setZero();
    for (const ProjectorMatch& match : match_cells(code, cells, points)) {
        const float x_px = match.point_g_m.x() / 0.002f;
        EXPECT_TRUE(x_px < 148.0f || x_px > 172.0f) << x_px;
    }
}

/// A fifth of the pixels without depth, anywhere.
TEST(GrayCode, HolesInTheDepthPictureDoNoHarm) {
    const CellPicture cells = decode_cells(code, seen_pictures(), width_px, height_px);
    auto points = points_on_plane();
    std::mt19937 random(5);
    for (auto& point : points)
        if (std::uniform_real_distribution<float>()(random) < 0.2f) point.setZero();
    const auto matches = match_cells(code, cells, points);
    EXPECT_GT(matches.size(), 1500U);
    EXPECT_LT(rms_px(matches), 0.7);
}

TEST(GrayCode, ADarkProjectorLightsNothing) {
    auto seen = seen_pictures();
    for (auto& picture : seen) picture = seen[1];
    EXPECT_EQ(decode_cells(code, seen, width_px, height_px).lit, 0);
    seen.pop_back();
    EXPECT_THROW(decode_cells(code, seen, width_px, height_px), Error);
}

}  // namespace
}  // namespace touchstone
