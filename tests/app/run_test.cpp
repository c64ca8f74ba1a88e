#include <Eigen/Core>
#include <array>
#include <cstdio>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "platform/image/png_file.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using test::ProgramResult;
using test::run_program;
using test::RunningProgram;

std::vector<nlohmann::json> read_lines(const std::filesystem::path& path) {
    std::vector<nlohmann::json> lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
}

TEST(Run, StepPaceWritesEveryFrameOnceAndIsLiveByFrame25) {
    const TemporaryFolder folder;
    const ProgramResult result =
        run_program({TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat?seed=5&frames=40", "--pace", "step",
                     "--display", "headless", "--events", (folder / "events.jsonl").string(), "--maps",
                     (folder / "maps").string(), "--shots", (folder / "shots").string()});
    ASSERT_EQ(result.status, 0) << result.err;
    const std::vector<nlohmann::json> lines = read_lines(folder / "events.jsonl");
    ASSERT_EQ(lines.size(), 40u);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_EQ(lines[i].at("frame"), i);
        EXPECT_TRUE(lines[i].at("touches").is_array());
        EXPECT_TRUE(lines[i].at("hovers").is_array());
        EXPECT_EQ(lines[i].at("state"), i < 20 ? "scanning" : "live");
        const std::string name =
            "frame-" + std::string(6 - std::to_string(i).size(), '0') + std::to_string(i);
        const Image8 foreground = read_png_8(folder / ("maps/" + name + ".foreground.png"));
        EXPECT_EQ(foreground.width_px, 640);
        EXPECT_EQ(foreground.height_px, 480);
        EXPECT_EQ(foreground.channels, 1);
        EXPECT_TRUE(std::filesystem::exists(folder / ("maps/" + name + ".touch.png")));
        EXPECT_TRUE(std::filesystem::exists(folder / ("shots/" + name + ".png")));
    }
    EXPECT_EQ(read_png_8(folder / "shots/frame-000039.png").width_px, 1280);
}

TEST(Run, FramesEndsTheRunAndDashMeansStandardOutput) {
    const ProgramResult result = run_program({TOUCHSTONE_PROGRAM, "--sensor", "sim:flat", "--pace", "step",
                                              "--frames", "3", "--display", "headless", "--events", "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(std::ranges::count(result.out, '\n'), 3);
}

/// What a user reads who has named everything in a file, started from another folder.
TEST(Run, AConfigurationStandsForItselfAndTheLogSaysWhatComesOfIt) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "mine");
    std::ofstream(folder / "mine/table.toml")
        << "[sensor]\nuri = \"sim:flat?hands=0&seed=3\"\n[scan]\nfile = \"table.scan\"\n[volume]\nsize_vox = "
           "64\n[tuio]\nport = 3444\n[areas]\nfile = \"areas.toml\"\n";
    std::ofstream(folder / "mine/areas.toml")
        << "[[area]]\nname = \"far\"\ncorners_mm = [[3000, 2000], [3200, 2000], [3200, 2200]]\n"
           "[[area]]\nname = \"near\"\ncorners_mm = [[-100, -100], [4000, -100], [0, 100]]\n";
    const ProgramResult result =
        run_program({TOUCHSTONE_PROGRAM, "--config", (folder / "mine/table.toml").string(), "--pace", "step",
                     "--frames", "25", "--display", "headless"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "mine/table.scan"));
    EXPECT_THAT(result.err, testing::HasSubstr("touches go to TUIO at 127.0.0.1:3444"));
    EXPECT_THAT(result.err, testing::HasSubstr("area far lies outside the interactive area"));
    EXPECT_THAT(result.err, testing::Not(testing::HasSubstr("area near lies")));
    EXPECT_THAT(result.err, testing::HasSubstr("ended after 25 frames and 0 touches"));
    const std::size_t at = result.err.find("interactive area: ");
    ASSERT_NE(at, std::string::npos) << result.err;
    float width_mm = 0.0F, height_mm = 0.0F;
    std::array<Eigen::Vector2f, 3> corners;
    ASSERT_EQ(std::sscanf(result.err.c_str() + at,
                          "interactive area: %f x %f mm, corners_mm = [[%f, %f], [%f, %f], [%f, %f]",
                          &width_mm, &height_mm, &corners[0].x(), &corners[0].y(), &corners[1].x(),
                          &corners[1].y(), &corners[2].x(), &corners[2].y()),
              8)
        << result.err;
    EXPECT_GT(width_mm, 200.0F);
    EXPECT_NEAR((corners[1] - corners[0]).norm(), width_mm, 2.0F) << "written to the millimetre";
    EXPECT_NEAR((corners[2] - corners[1]).norm(), height_mm, 2.0F);
}

TEST(Run, TheSameSeedGivesTheSameEvents) {
    const auto events = [] {
        return run_program({TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat?seed=9&empty=1&frames=75",
                            "--pace", "step", "--display", "headless", "--events", "-"})
            .out;
    };
    const std::string first = events();
    EXPECT_THAT(first, testing::HasSubstr("hovers\":[{"));
    EXPECT_EQ(first, events());
}

TEST(Run, LivePaceKeepsPerceptionAndPresentationApart) {
    const TemporaryFolder folder;
    const ProgramResult result =
        run_program({TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:mixed?rate=30", "--frames", "30",
                     "--display", "headless", "--events", "-", "--shots", (folder / "shots").string()});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(std::ranges::count(result.out, '\n'), 30);
    EXPECT_FALSE(std::filesystem::is_empty(folder / "shots"));
}

/// The table is of wood, and its shaded scan is bluish: over the camera's own picture the ball is grey, too.
TEST(Run, TheCamerasOwnPictureLiesUnderWhatIsVirtual) {
    const TemporaryFolder folder;
    std::ofstream(folder / "table.toml") << "[rendering]\nview = \"camera\"\n";
    const ProgramResult result =
        run_program({TOUCHSTONE_PROGRAM, "run", "--config", (folder / "table.toml").string(), "--sensor",
                     "sim:flat?seed=5&hands=0", "--frames", "32", "--pace", "step", "--display", "headless",
                     "--scene", "mirror", "--shots", (folder / "shots").string()});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto count = [&](const char* frame) {
        const Image8 shot = read_png_8(folder / (std::string("shots/") + frame));
        std::pair<int, int> wood_and_grey;
        for (int y = 60; y < 660; ++y) {
            for (int x = 400; x < 1220; ++x) {
                const std::uint8_t* pixel =
                    &shot.pixels[static_cast<std::size_t>((y * shot.width_px + x) * shot.channels)];
                wood_and_grey.first += pixel[0] > pixel[2] + 30;
                wood_and_grey.second += pixel[2] > pixel[0] + 10;
            }
        }
        return wood_and_grey;
    };
    const auto [wood_before, grey_before] = count("frame-000015.png");
    const auto [wood, grey] = count("frame-000031.png");
    EXPECT_GT(wood_before, 400000) << "of 492000 pixels, while it scans";
    EXPECT_GT(wood, 400000);
    EXPECT_GT(grey, grey_before + 3000) << "the ball, which mirrors the sky, and the model";
}

/// Places of all touches of a run with a bias of 10 mm along the finger, of none, and before it is known.
TEST(Run, TheBiasOfTouchesIsTakenOffAndAskedForWhereItIsNotKnown) {
    const TemporaryFolder folder;
    const auto touched_mm = [&](const std::string& bias) {
        const std::filesystem::path file = folder / "touch.bias", config = folder / "table.toml";
        if (!bias.empty()) std::ofstream(file) << bias;
        std::ofstream(config) << "[tuio]\nenabled = false\n[touch]\nbias_file = \"" << file.string()
                              << "\"\n";
        const ProgramResult result = run_program(
            {TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat?seed=9&hands=2&empty=0.9&frames=90", "--pace",
             "step", "--display", "headless", "--config", config.string(), "--events", "-"});
        EXPECT_EQ(result.status, 0) << result.err;
        std::vector<Eigen::Vector3d> places;
        std::istringstream lines(result.out);
        for (std::string line; std::getline(lines, line);) {
            const nlohmann::json frame = nlohmann::json::parse(line);
            for (const auto& touch : frame.at("touches")) {
                const auto at = touch.at("camera_mm").get<std::array<double, 3>>();
                places.emplace_back(at[0], at[1], at[2]);
            }
        }
        return places;
    };
    EXPECT_TRUE(touched_mm("").empty());
    const auto plain_mm = touched_mm(R"({"along_mm": 0, "across_mm": 0})");
    const auto moved_mm = touched_mm(R"({"along_mm": 10, "across_mm": 0})");
    ASSERT_GT(plain_mm.size(), 5u);
    ASSERT_EQ(moved_mm.size(), plain_mm.size());
    for (std::size_t i = 0; i < plain_mm.size(); ++i)
        EXPECT_NEAR((moved_mm[i] - plain_mm[i]).norm(), 10.0, 0.02)
            << i << ": written to 0.01 mm on each axis";
}

TEST(Run, WaitsForACameraAndEndsOnSigterm) {
    RunningProgram program({TOUCHSTONE_PROGRAM, "run", "--display", "headless", "--events", "-"});
    for (int i = 0; i < 600 && program.errors_so_far().find("waiting") == std::string::npos; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_THAT(program.errors_so_far(), testing::HasSubstr("waiting for one to be plugged in"));
    const ProgramResult result = program.finish(SIGTERM);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, "");
}

}  // namespace
}  // namespace touchstone
