#include "app/fault_reports.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/camera/depth_camera.hpp"
#include "platform/system/percentile.hpp"
#include "tests/support/source_frames.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using test::frames_of;
using testing::ElementsAre;
using testing::MatchesRegex;
using testing::SizeIs;

DepthFrame numbered_frame(int index) {
    DepthFrame frame{index, static_cast<std::uint64_t>(index) * 33'333, 32, 24, {}, {}, {}};
    frame.intrinsics = {30.25f, 31.5f, 15.75f, 12, 32, 24, {}};
    for (int i = 0; i < 32 * 24; ++i)
        frame.depth_mm.push_back(static_cast<std::uint16_t>(i % 7 == 0 ? 0 : 400 + (index * 131 + i) % 9000));
    return frame;
}

class FaultReportsTest : public testing::Test {
  protected:
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const auto& entry : fs::directory_iterator(dir_)) all.push_back(entry.path().filename());
        std::ranges::sort(all);
        return all;
    }
    /// One report of two frames.
    void report(const std::string& reason, int most = 5) const {
        FaultReports reports({dir_, most});
        for (int index = 0; index < 4; ++index) reports.keep(numbered_frame(index));
        reports.report(reason);
    }

    TemporaryFolder folder_;
    const fs::path dir_ = folder_ / "made/with/parents";
};

TEST_F(FaultReportsTest, EverySecondFrameIsReplayedAsItWas) {
    {
        FaultReports reports({dir_, 5});
        for (int index = 10; index < 18; ++index) reports.keep(numbered_frame(index));
        reports.report("frozen");
    }
    ASSERT_THAT(names(), ElementsAre(MatchesRegex("fault-[0-9]{8}-[0-9]{6}-frozen")));
    const std::vector<DepthFrame> replayed = frames_of("seq:" + (dir_ / names()[0]).string());
    ASSERT_THAT(replayed, SizeIs(4));
    for (std::size_t i = 0; i < 4; ++i) {
        const DepthFrame expected = numbered_frame(10 + 2 * static_cast<int>(i));
        EXPECT_EQ(replayed[i].index, expected.index);
        EXPECT_EQ(replayed[i].depth_mm, expected.depth_mm);
        EXPECT_EQ(replayed[i].intrinsics.fx_px, 30.25f);
        EXPECT_EQ(replayed[i].intrinsics.fy_px, 31.5f);
        EXPECT_EQ(replayed[i].intrinsics.cx_px, 15.75f);
    }
}

TEST_F(FaultReportsTest, OnlyTheOldestOfOurOwnFoldersAreDeleted) {
    for (const char* others : {"fault-notes", "fault-20200101-000000", "fault-20200101-000000-lost-copy",
                               "photos", "fault-20200101-000000-LOST"})
        fs::create_directories(dir_ / others);
    std::ofstream(dir_ / "fault-20200101-000000-file") << "not a folder";
    fs::create_directory_symlink(dir_ / "photos", dir_ / "fault-20200101-000000-link");
    for (const char* ours : {"fault-20200101-000001-lost", "fault-20200101-000001-lost-2",
                             "fault-20200102-000000-frozen", "fault-20200101-000000-blind.new"})
        fs::create_directories(dir_ / ours / "inner");
    report("silent", 2);
    const std::vector<std::string> left = names();
    EXPECT_THAT(left, SizeIs(9)) << testing::PrintToString(left);
    EXPECT_FALSE(fs::exists(dir_ / "fault-20200101-000001-lost"));
    EXPECT_FALSE(fs::exists(dir_ / "fault-20200101-000001-lost-2"));
    EXPECT_FALSE(fs::exists(dir_ / "fault-20200101-000000-blind.new"));
    EXPECT_TRUE(fs::exists(dir_ / "fault-20200102-000000-frozen"));
}

TEST_F(FaultReportsTest, ReportsOfOneSecondHaveNumbers) {
    for (int i = 0; i < 4; ++i) report("lost");
    EXPECT_THAT(names(), SizeIs(4));
}

TEST_F(FaultReportsTest, AFaultWhileAReportIsWrittenIsDropped) {
    {
        FaultReports reports({dir_, 5});
        for (int index = 0; index < 4; ++index) reports.keep(numbered_frame(index));
        reports.report("silent");
        reports.report("lost");
    }
    EXPECT_THAT(names(), ElementsAre(MatchesRegex(".*-silent")));
}

TEST_F(FaultReportsTest, WithoutFramesThereIsNoReport) {
    { FaultReports({dir_, 5}).report("lost"); }
    EXPECT_FALSE(fs::exists(dir_));
}

TEST_F(FaultReportsTest, WhatCannotBeWrittenIsNoFailure) {
    fs::create_directories(dir_.parent_path());
    std::ofstream(dir_) << "a file where the folder should be";
    report("lost");
    EXPECT_TRUE(fs::is_regular_file(dir_));
}

/// The noisy simulator at the size of a Kinect: what ten seconds take, and what the loop pays for a frame.
TEST_F(FaultReportsTest, TenSecondsFitTheirMemoryAndCostTheLoopLittle) {
    DepthCamera camera = DepthCamera::open("sim:mixed?hands=2&seed=3&frames=300", Pace::step);
    FrameRing all(10.0, 1'000'000'000);
    FaultReports reports({dir_, 5});
    std::vector<double> keep_ms, skip_ms, pack_ms;
    const auto measure = [](std::vector<double>& times_ms, const auto& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        times_ms.push_back(took.count());
    };
    for (;;) {
        const ReadResult result = camera.read(10'000);
        const auto* frame = std::get_if<DepthFrame>(&result);
        if (frame == nullptr) break;
        measure(frame->index % 2 == 0 ? keep_ms : skip_ms, [&] { reports.keep(*frame); });
        measure(pack_ms, [&] { all.add(*frame); });
    }
    ASSERT_EQ(all.frames(), 300u);
    std::printf(
        "300 frames: %.1f MB; packing one %.2f ms in median, keeping one %.3f ms in median, 90 %% within "
        "%.3f ms\n",
        static_cast<double>(all.bytes()) / 1e6, percentile(pack_ms, 50), percentile(keep_ms, 50),
        percentile(keep_ms, 90));
    EXPECT_LT(all.bytes(), 40'000'000u);
    EXPECT_LT(percentile(keep_ms, 50), 1.0);
}

}  // namespace
}  // namespace touchstone
