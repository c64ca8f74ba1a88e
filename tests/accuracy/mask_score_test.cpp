#include "tests/accuracy/mask_score.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "platform/image/png_file.hpp"
#include "platform/system/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

constexpr std::size_t pixels = 10'000;
using Mask = std::vector<std::uint8_t>;
const std::vector<std::uint16_t> depth_everywhere(pixels, 800);

Mask marked(std::size_t first, std::size_t count) {
    Mask mask(pixels, 0);
    std::fill_n(mask.begin() + static_cast<std::ptrdiff_t>(first), count, std::uint8_t{255});
    return mask;
}

TEST(MaskScorer, ScoresTheOverlapFromTheFourthFrameWithForegroundOn) {
    MaskScorer scorer;
    for (int i = 0; i < 5; ++i) scorer.take_frame(marked(0, 2000), marked(1000, 2000), depth_everywhere);
    ASSERT_EQ(scorer.result().overlap.size(), 2u);
    EXPECT_DOUBLE_EQ(scorer.result().overlap[0], 1000.0 / 3000.0);
}

TEST(MaskScorer, ForegroundTooSmallEndsTheRow) {
    MaskScorer scorer;
    for (int i = 0; i < 3; ++i) scorer.take_frame(marked(0, 2000), marked(0, 2000), depth_everywhere);
    scorer.take_frame(marked(0, 1500), marked(0, 1500), depth_everywhere);
    for (int i = 0; i < 3; ++i) scorer.take_frame(marked(0, 2000), marked(0, 2000), depth_everywhere);
    EXPECT_TRUE(scorer.result().overlap.empty());
    EXPECT_TRUE(scorer.result().false_area.empty());
}

TEST(MaskScorer, PixelsWithoutAReadingDoNotCount) {
    auto depth = depth_everywhere;
    std::fill_n(depth.begin(), 1000, std::uint16_t{0});
    MaskScorer scorer;
    for (int i = 0; i < 4; ++i) scorer.take_frame(marked(0, 2000), marked(0, 1500), depth);
    EXPECT_DOUBLE_EQ(scorer.result().overlap.at(0), 0.5);
    scorer.take_frame(marked(0, 0), marked(0, 1900), depth);
    EXPECT_DOUBLE_EQ(scorer.result().false_area.at(0), 0.1);
}

TEST(MaskScorer, AMissingMaskIsAnEmptyOne) {
    MaskScorer scorer;
    for (int i = 0; i < 4; ++i) scorer.take_missing(marked(0, 2000), depth_everywhere);
    EXPECT_DOUBLE_EQ(scorer.result().overlap.at(0), 0.0);
    EXPECT_EQ(scorer.result().missing, 4);
}

class MaskFolders : public testing::Test {
  protected:
    void write(const std::string& name, const Mask& mask) {
        write_png(folder_ / name, Image8{100, 100, 1, mask});
    }
    void write_depth(const std::string& name) {
        write_png(folder_ / name, Image16{100, 100, depth_everywhere});
    }

    TemporaryFolder temporary_;
    const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(MaskFolders, AreScoredFromFrame60On) {
    for (const char* number : {"000059", "000060", "000061", "000062", "000063"}) {
        write(std::string("truth-") + number + ".mask.png", marked(0, 2000));
        write_depth(std::string("frame-") + number + ".depth.png");
        write(std::string("frame-") + number + ".foreground.png", marked(0, 1000));
    }
    const MaskScore score = score_masks(folder_, folder_);
    EXPECT_EQ(score.overlap, (std::vector<double>{0.5}));
    const auto json = nlohmann::json::parse(json_of(score));
    EXPECT_EQ(json["iou_median"], 0.5);
    EXPECT_TRUE(json["false_area"].is_null());
    EXPECT_FALSE(line_of(score).empty());
}

TEST_F(MaskFolders, WithoutTruthAreAnError) {
    try {
        score_masks(folder_ / "missing", folder_);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::no_input);
    }
}

}  // namespace
}  // namespace touchstone
