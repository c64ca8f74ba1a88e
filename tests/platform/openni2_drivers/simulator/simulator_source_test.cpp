#include "platform/openni2_drivers/simulator/simulator_source.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "platform/image/png_file.hpp"
#include "platform/openni2_drivers/simulator/hand_script.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

std::vector<SourceFrame> play(const std::string& uri, bool color = false) {
    const auto source = open_simulator(uri);
    source->enable_color(color);
    std::vector<SourceFrame> frames(1);
    while (source->next(frames.back())) frames.emplace_back();
    frames.pop_back();
    return frames;
}

class SimulatorSourceFiles : public testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    nlohmann::json truth() const {
        std::ifstream file(folder_ / "truth.json");
        return nlohmann::json::parse(file);
    }

    std::filesystem::path folder_ = testing::TempDir() + "simulator_source_test." +
                                    testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST(SimulatorSource, SaysWhatAKinectSays) {
    const auto source = open_simulator("flat?rate=60");
    const SourceInfo& info = source->info();
    EXPECT_EQ(info.intrinsics.width_px, 640);
    EXPECT_EQ(info.intrinsics.height_px, 480);
    EXPECT_FLOAT_EQ(info.intrinsics.fx_px, 575.8F);
    EXPECT_FLOAT_EQ(info.intrinsics.cx_px, 319.5F);
    EXPECT_TRUE(info.has_color);
    EXPECT_EQ(info.default_pace, Pace::live);
    EXPECT_DOUBLE_EQ(info.rate_hz, 60.0);
}

TEST(SimulatorSource, CountsFramesAndTimesAndEnds) {
    const std::vector<SourceFrame> frames = play("flat?frames=4&hands=0");
    ASSERT_EQ(frames.size(), 4U);
    EXPECT_EQ(frames[3].index, 3);
    EXPECT_EQ(frames[1].timestamp_us, 33333U);
    EXPECT_EQ(frames[3].timestamp_us, 100000U);
    EXPECT_EQ(frames[0].depth_mm.size(), 640U * 480U);
    EXPECT_TRUE(frames[0].color_rgb.empty());
}

TEST(SimulatorSource, ColourIsMadeOnlyWhenAsked) {
    const std::vector<SourceFrame> frames = play("cluttered?frames=2&empty=0", true);
    EXPECT_EQ(frames[1].color_rgb.size(), 3U * 640U * 480U);
}

TEST(SimulatorSource, TheSeedDecidesEveryPixel) {
    const std::string uri = "mixed?frames=60&hands=2&empty=0&seed=";
    const std::vector<SourceFrame> one = play(uri + "5", true);
    const std::vector<SourceFrame> same = play(uri + "5", true);
    const std::vector<SourceFrame> other = play(uri + "6");
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].depth_mm, same[i].depth_mm);
        EXPECT_EQ(one[i].color_rgb, same[i].color_rgb);
    }
    EXPECT_NE(one[59].depth_mm, other[59].depth_mm);
}

TEST(SimulatorSource, AnEmptySceneWithoutNoiseStandsStill) {
    const std::vector<SourceFrame> frames = play("bowl?frames=3&noise=0&hands=0");
    EXPECT_EQ(frames[0].depth_mm, frames[2].depth_mm);
    EXPECT_NE(frames[0].depth_mm[636], 0);
}

/// Distance in mm from a point to the nearest point of the hand that the depth shows within 8 pixels of it.
double distance_to_hand_mm(const Eigen::Vector3d& point_c, const Image16& depth, const Image8& mask) {
    const auto u_px = std::lround(575.8 * point_c.x() / point_c.z() + 319.5);
    const auto v_px = std::lround(575.8 * point_c.y() / point_c.z() + 239.5);
    double nearest_mm = 1e9;
    for (long v = std::max(0L, v_px - 8); v <= std::min(479L, v_px + 8); ++v)
        for (long u = std::max(0L, u_px - 8); u <= std::min(639L, u_px + 8); ++u) {
            const auto i = static_cast<std::size_t>(v * 640 + u);
            if (mask.pixels[i] == 0) continue;
            const double z_mm = depth.pixels[i];
            const Eigen::Vector3d seen(z_mm * (static_cast<double>(u) - 319.5) / 575.8,
                                       z_mm * (static_cast<double>(v) - 239.5) / 575.8, z_mm);
            nearest_mm = std::min(nearest_mm, (seen - point_c).norm());
        }
    return nearest_mm;
}

TEST_F(SimulatorSourceFiles, TheFingerInTheDepthIsWhereTheTruthSays) {
    play("flat?frames=600&hands=1&noise=0&empty=0&seed=8&truth=" + (folder_ / "truth.json").string() +
         "&masks=" + folder_.string());
    const nlohmann::json tips = truth()["tips"];
    ASSERT_EQ(tips.size(), 600U);
    sim::Random random(8, 0x4a4d0);
    const sim::HandShape shape = sim::make_hand_shape(random, random.chance(0.7F) ? 1.0F : -1.0F);
    const double radius_mm = 1000.0 * static_cast<double>(shape.fingertip_radius_m);
    const double tilt = 25.0 * std::numbers::pi / 180.0;
    const Eigen::Vector3d up_c(0.0, -std::sin(tilt), -std::cos(tilt));
    int seen = 0;
    for (std::size_t frame = 0; frame < tips.size(); ++frame)
        for (const nlohmann::json& tip : tips[frame]) {
            const double gap_mm = tip["gap_mm"];
            if (tip["finger"] != 0 || gap_mm > 1.0) continue;
            const Eigen::Vector3d foot(tip["camera_mm"][0], tip["camera_mm"][1], tip["camera_mm"][2]);
            EXPECT_NEAR(-foot.dot(up_c), 1000.0, 0.1) << "the point lies on the table, 1 m below the camera";
            const std::string number = fmt::format("{:06d}", frame);
            const Image16 depth = read_png_16(folder_ / ("frame-" + number + ".depth.png"));
            const Image8 mask = read_png_8(folder_ / ("truth-" + number + ".mask.png"));
            // Half a millimetre of rounding along the ray, and the ball shows only at some pixels.
            EXPECT_NEAR(distance_to_hand_mm(foot + (gap_mm + radius_mm) * up_c, depth, mask), radius_mm, 0.6)
                << frame;
            ++seen;
        }
    EXPECT_GE(seen, 30);
}

TEST_F(SimulatorSourceFiles, MasksAreWhereTheDepthDiffersFromTheEmptyScene) {
    const std::string keys = "&seed=3&noise=0&frames=100";
    const std::vector<SourceFrame> empty = play("cluttered?hands=0" + keys);
    const std::vector<SourceFrame> frames =
        play("cluttered?hands=2&empty=1" + keys + "&masks=" + folder_.string());
    int in_mask = 0;
    for (const int index : {0, 20, 60, 80, 99}) {
        const Image8 mask = read_png_8(folder_ / ("truth-0000" + std::string(index < 10 ? "0" : "") +
                                                  std::to_string(index) + ".mask.png"));
        ASSERT_EQ(mask.pixels.size(), 640U * 480U);
        for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
            const int nearer_mm = empty[0].depth_mm[i] - frames[static_cast<std::size_t>(index)].depth_mm[i];
            in_mask += mask.pixels[i] == 255;
            ASSERT_GE(nearer_mm, 0);
            ASSERT_TRUE(nearer_mm == 0 || mask.pixels[i] == 255);
        }
        if (index <= 20) {
            EXPECT_EQ(in_mask, 0);
        }
    }
    EXPECT_GT(in_mask, 5000);
}

TEST_F(SimulatorSourceFiles, TruthIsValidWhenThePlayStopsEarly) {
    const auto source =
        open_simulator("flat?frames=500&hands=2&empty=0.5&truth=" + (folder_ / "truth.json").string());
    SourceFrame frame;
    for (int i = 0; i < 60; ++i) source->next(frame);
    const nlohmann::json now = truth();
    EXPECT_EQ(now["frames"], 60);
    EXPECT_EQ(now["tips"].size(), 60U);
    EXPECT_EQ(now["fps"], 30);
    EXPECT_TRUE(now["tips"][0].empty());
    EXPECT_FALSE(now["tips"][59].empty());
}

TEST(SimulatorSource, RefusesWhatItCannotDo) {
    EXPECT_THROW(open_simulator("flat?hands=9"), Error);
    EXPECT_THROW(open_simulator("flat?truth=/nowhere/at/all.json"), Error);
}

}  // namespace
}  // namespace touchstone
