// The program with a simulated camera that fails as real ones do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/run_program.hpp"
#include "tests/support/source_frames.hpp"

namespace touchstone {
namespace {

using test::frames_of;
using test::ProgramResult;
using test::run_program;
using ::testing::HasSubstr;
using ::testing::Not;

ProgramResult run_with(const std::string& sensor, int frames, const std::string& pace = "live") {
    return run_program({TOUCHSTONE_PROGRAM, "run", "--sensor", sensor, "--pace", pace, "--frames",
                        std::to_string(frames), "--display", "headless", "--events", "-"});
}

std::vector<nlohmann::json> lines_of(const ProgramResult& result) {
    std::vector<nlohmann::json> lines;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
}

/// Every touch that went down has come up, except those of the very last frame.
void expect_no_touch_left_over(const std::vector<nlohmann::json>& lines) {
    std::set<int> down;
    for (const auto& line : lines) {
        for (const auto& touch : line["touches"]) {
            if (touch["phase"] == "down")
                EXPECT_TRUE(down.insert(touch["id"].get<int>()).second) << line;
            else
                EXPECT_EQ(down.count(touch["id"].get<int>()), 1U) << line;
            if (touch["phase"] == "up") down.erase(touch["id"].get<int>());
        }
    }
    for (const auto& touch : lines.back()["touches"]) down.erase(touch["id"].get<int>());
    EXPECT_TRUE(down.empty());
}

TEST(RecoveryRun, AStallEndsWithARestartOfTheStream) {
    const ProgramResult result = run_with("sim:flat?hands=2&seed=3&empty=1&stall_at=4&fault_s=0", 150);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("restarting its stream"));
    EXPECT_THAT(result.err, Not(HasSubstr("opening it anew")));
    const auto lines = lines_of(result);
    ASSERT_EQ(lines.size(), 150U);
    EXPECT_EQ(lines.back()["state"], "live");
    expect_no_touch_left_over(lines);
}

TEST(RecoveryRun, AFrozenPictureIsAFault) {
    const ProgramResult result = run_with("sim:flat?hands=0&seed=3&freeze_at=2&fault_s=0", 120);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("same picture again"));
    EXPECT_EQ(lines_of(result).back()["state"], "live");
}

/// The folder of a fault report, replayed: the simulator's frames up to the freeze, then the last of them.
TEST(RecoveryRun, AFrozenPictureLeavesAReportThatReplays) {
    const TemporaryFolder folder;
    std::ofstream(folder / "table.toml")
        << "[health]\nfault_dir = \"" << (folder / "faults").string() << "\"\n";
    const ProgramResult result = run_program(
        {TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat?hands=0&seed=3&freeze_at=2&fault_s=0", "--frames",
         "80", "--display", "headless", "--config", (folder / "table.toml").string()});
    ASSERT_EQ(result.status, 0) << result.err;
    // A machine that is busy may find the camera silent, too.
    std::vector<std::filesystem::path> reports;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "faults"))
        if (entry.path().filename().string().ends_with("-frozen")) reports.push_back(entry.path());
    ASSERT_EQ(reports.size(), 1U) << result.err;
    const std::filesystem::path& report = reports.front();
    EXPECT_THAT(report.filename().string(), ::testing::MatchesRegex("fault-[0-9]{8}-[0-9]{6}-frozen"));
    const std::vector<DepthFrame> truth = frames_of("sim:flat?hands=0&seed=3&frames=60");
    const std::vector<DepthFrame> replayed = frames_of("seq:" + report.string());
    EXPECT_GT(replayed.size(), 8U) << "a busy machine drops many";
    for (const DepthFrame& frame : replayed) {
        const auto shown = static_cast<std::size_t>(std::min(frame.index, 59));
        EXPECT_TRUE(frame.depth_mm == truth[shown].depth_mm) << frame.index;
    }
    EXPECT_GE(replayed.back().index, 74) << "half a second of the frozen picture";
    EXPECT_EQ(run_with("seq:" + report.string(), 10, "step").status, 0);
}

TEST(RecoveryRun, PulledOutAndBackAgainTwice) {
    const ProgramResult result = run_with("sim:flat?hands=2&seed=3&empty=1&unplug_at=3&fault_s=1", 200);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("was unplugged"));
    const auto lines = lines_of(result);
    ASSERT_EQ(lines.size(), 200U);
    int returns = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) returns += lines[i]["frame"] < lines[i - 1]["frame"];
    EXPECT_GE(returns, 2);
    expect_no_touch_left_over(lines);
}

/// A finger is down when the camera goes. What it was is over in the first frame after its return: a receiver
/// that has lifted it would take its moving on for another finger.
TEST(RecoveryRun, NoTouchOutlivesTheCamera) {
    const ProgramResult result =
        run_with("sim:flat?hands=2&seed=9&empty=0.9&unplug_at=2.69&fault_s=0.3", 110, "step");
    EXPECT_EQ(result.status, 0) << result.err;
    const auto lines = lines_of(result);
    bool returned = false;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (lines[i]["frame"] > lines[i - 1]["frame"]) continue;
        returned = true;
        EXPECT_FALSE(lines[i - 1]["touches"].empty()) << "else this tells nothing";
        EXPECT_FALSE(lines[i]["touches"].empty());
        for (const auto& touch : lines[i]["touches"]) EXPECT_EQ(touch["phase"], "up") << lines[i];
    }
    EXPECT_TRUE(returned) << result.err;
    expect_no_touch_left_over(lines);
}

/// Every third picture is torn: on a busy machine one of them, or the one before it, may not be read. Each
/// that is said was not worked with: its line of events has the number of a frame before it.
TEST(RecoveryRun, ATornPictureAndAClockThatJumpsTouchNothing) {
    const ProgramResult result =
        run_with("sim:flat?hands=0&seed=3&rate=10&tear=2&tear_every=0.3&clock_jump=3", 45);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("clock has jumped"));
    EXPECT_THAT(result.err, HasSubstr("half of a picture is from the one before"));
    std::uint64_t last_us = 0;
    for (const auto& line : lines_of(result)) {
        EXPECT_TRUE(line["touches"].empty()) << line;
        const auto time_us = line["time_us"].get<std::uint64_t>();
        EXPECT_LT(time_us - last_us, 60'000'000U) << line << " (the clock has jumped by an hour)";
        last_us = time_us;
    }
}

}  // namespace
}  // namespace touchstone
