#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/run_program.hpp"
#include "tests/support/source_frames.hpp"

namespace touchstone {
namespace {

using test::frames_of;
using test::ProgramResult;
using test::run_program;
using test::RunningProgram;
using testing::AllOf;
using testing::HasSubstr;

class Record : public testing::Test {
  protected:
    std::vector<std::string> command(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {TOUCHSTONE_PROGRAM, "record", path_.string()});
        return arguments;
    }
    ProgramResult record(std::vector<std::string> arguments) const {
        return run_program(command(std::move(arguments)));
    }
    std::size_t files() const {
        const std::filesystem::directory_iterator all(folder_.path());
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }
    /// Ended with this status and one line past the log.
    static void expect_complaint(const ProgramResult& result, int status,
                                 const testing::Matcher<std::string>& why) {
        EXPECT_EQ(result.status, status) << result.err;
        const std::size_t line = result.err.find("touchstone: ");
        ASSERT_NE(line, std::string::npos) << result.err;
        EXPECT_THAT(result.err.substr(line), why);
        EXPECT_EQ(std::ranges::count(result.err.substr(line), '\n'), 1) << result.err;
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "table.oni";
};

TEST_F(Record, EveryDepthOfEveryFrameComesBackThroughTheStockDriver) {
    const std::string sensor = "sim:flat?hands=1&seed=3";
    const ProgramResult result = record({"--sensor", sensor, "--pace", "step", "--frames", "60"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("table.oni: 60 frames, 2.0 s"), HasSubstr("MB")));
    EXPECT_THAT(result.err, testing::Not(HasSubstr("\x1b"))) << "no progress line where there is no terminal";
    EXPECT_EQ(files(), 1u);
    const std::vector<DepthFrame> truth = frames_of(sensor + "&frames=60"), replayed = frames_of(path_);
    ASSERT_EQ(truth.size(), 60u);
    ASSERT_EQ(replayed.size(), 60u);
    for (std::size_t i = 0; i < 60; ++i) {
        EXPECT_TRUE(replayed[i].depth_mm == truth[i].depth_mm) << "frame " << i;
        EXPECT_EQ(replayed[i].timestamp_us, truth[i].timestamp_us);
        EXPECT_TRUE(replayed[i].color_rgb.empty());
    }
    EXPECT_NEAR(replayed[0].intrinsics.fx_px, truth[0].intrinsics.fx_px, 0.01);
    const ProgramResult run = run_program({TOUCHSTONE_PROGRAM, "run", "--sensor", path_.string(), "--display",
                                           "headless", "--voxels", "128", "--events", "-"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(std::ranges::count(run.out, '\n'), 60);
    EXPECT_THAT(run.out, HasSubstr("\"state\":\"live\""));
}

TEST_F(Record, LivePaceKeepsEveryFrameFromItsFirst) {
    const ProgramResult result = record({"--sensor", "sim:flat?seed=3", "--frames", "30"});
    ASSERT_EQ(result.status, 0) << result.err;
    const std::vector<DepthFrame> frames = frames_of(path_);
    ASSERT_GE(frames.size(), 30u);
    EXPECT_LE(frames.size(), 45u) << "a busy machine reads late: what it did not read is in the file too";
    for (std::size_t i = 1; i < frames.size(); ++i)
        EXPECT_NEAR(static_cast<double>(frames[i].timestamp_us - frames[i - 1].timestamp_us), 33'333, 2);
}

TEST_F(Record, ColourOnDemand) {
    ASSERT_EQ(record({"--sensor", "sim:flat?frames=5", "--pace", "step", "--color"}).status, 0);
    const std::vector<DepthFrame> frames = frames_of(path_, true);
    ASSERT_EQ(frames.size(), 5u) << "until the source's end";
    for (const DepthFrame& frame : frames)
        EXPECT_EQ(frame.color_rgb.size(), 3 * frame.depth_mm.size()) << frame.index;
}

TEST_F(Record, WhatCameBeforeTheCameraWasLostIsKept) {
    const ProgramResult result = record({"--sensor", "sim:flat?unplug_at=1&fault_s=60", "--pace", "step"});
    expect_complaint(result, 69, AllOf(HasSubstr("was unplugged"), HasSubstr("table.oni")));
    EXPECT_EQ(frames_of(path_).size(), 30u);
    EXPECT_EQ(files(), 1u);
}

TEST_F(Record, ASignalEndsIt) {
    RunningProgram program(command({"--sensor", "sim:flat", "--pace", "live"}));
    const auto beside = path_.string() + ".new";
    std::error_code none;
    for (int i = 0; i < 200; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (std::filesystem::exists(beside, none) && std::filesystem::file_size(beside, none) > 500'000)
            break;
    }
    const ProgramResult result = program.finish(SIGTERM);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_GE(frames_of(path_).size(), 1u);
    EXPECT_EQ(files(), 1u);
}

TEST_F(Record, AFileIsReplacedOnlyByAWholeOne) {
    std::ofstream(path_) << "old";
    expect_complaint(record({"--sensor", "seq:/not/there"}), 66, HasSubstr("/not/there"));
    expect_complaint(record({"--sensor", "sim:flat?unplug_at=0&fault_s=60"}), 69, HasSubstr("unplugged"));
    EXPECT_EQ(std::filesystem::file_size(path_), 3u);
    EXPECT_EQ(record({"--sensor", "sim:flat?frames=3", "--pace", "step"}).status, 0);
    EXPECT_EQ(frames_of(path_).size(), 3u);
    EXPECT_EQ(files(), 1u);
}

TEST_F(Record, WithoutAFrameThereIsNoFile) {
    expect_complaint(record({"--sensor", "sim:flat?unplug_at=0&fault_s=60"}), 69, HasSubstr("unplugged"));
    EXPECT_EQ(files(), 0u);
}

TEST_F(Record, TargetsThatCannotBeWritten) {
    const auto to = [](const std::string& file) {
        return run_program({TOUCHSTONE_PROGRAM, "record", "--sensor", "sim:flat", file});
    };
    expect_complaint(to("/nowhere/table.oni"), 74, HasSubstr("/nowhere/table.oni"));
    expect_complaint(to(folder_ / "table.png"), 64, HasSubstr("table.png"));
    std::filesystem::create_directory(path_);
    expect_complaint(to(path_), 74, AllOf(HasSubstr("table.oni"), HasSubstr("not a file")));
    std::filesystem::remove(path_);
    std::filesystem::create_symlink("/dev/full", path_);
    expect_complaint(to(path_), 74, HasSubstr("not a file"));
    EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace touchstone
