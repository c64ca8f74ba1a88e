#include "app/camera_recovery.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "app/frame_health.hpp"
#include "platform/image/png_file.hpp"

namespace touchstone {
namespace {

using std::chrono::milliseconds;

CameraRecovery::Time at(int ms) { return CameraRecovery::Time{} + milliseconds(100'000 + ms); }

/// Remedies with their times, asked every 100 ms.
std::vector<std::pair<int, Remedy>> remedies(CameraRecovery& recovery, int from_ms, int to_ms) {
    std::vector<std::pair<int, Remedy>> list;
    for (int ms = from_ms; ms <= to_ms; ms += 100) {
        const Remedy remedy = recovery.due(at(ms));
        if (remedy != Remedy::none) list.emplace_back(ms, remedy);
    }
    return list;
}

TEST(CameraRecovery, FromGentleToRoughWithLongerPauses) {
    CameraRecovery recovery;
    recovery.healthy(at(0));
    EXPECT_FALSE(recovery.ailing());
    const std::vector<std::pair<int, Remedy>> expected{
        {500, Remedy::restart_stream},      {1500, Remedy::reopen},
        {3500, Remedy::reset_and_reopen},   {7500, Remedy::reset_and_reopen},
        {15'500, Remedy::reset_and_reopen}, {25'500, Remedy::reset_and_reopen}};
    EXPECT_EQ(remedies(recovery, 0, 30'000), expected);
    EXPECT_TRUE(recovery.ailing());
}

TEST(CameraRecovery, AGoodFrameBeginsAnew) {
    CameraRecovery recovery;
    recovery.healthy(at(0));
    remedies(recovery, 0, 4000);
    recovery.healthy(at(4000));
    EXPECT_FALSE(recovery.ailing());
    EXPECT_EQ(remedies(recovery, 4000, 4600).front(), (std::pair{4500, Remedy::restart_stream}));
}

TEST(CameraRecovery, TheFirstFrameMayTakeLonger) {
    CameraRecovery recovery;
    recovery.opened(at(0));
    EXPECT_EQ(remedies(recovery, 0, 3500).front().first, 3000);
}

TEST(CameraRecovery, OneThatIsLostAgainAndAgainIsOpenedLessOften) {
    CameraRecovery recovery;
    EXPECT_TRUE(recovery.may_open(at(0)));
    recovery.lost(at(0));
    EXPECT_FALSE(recovery.may_open(at(200)));
    EXPECT_TRUE(recovery.may_open(at(250)));
    recovery.lost(at(300));
    EXPECT_FALSE(recovery.may_open(at(700)));
    for (int i = 0; i < 20; ++i) recovery.lost(at(1000));
    EXPECT_FALSE(recovery.may_open(at(3400)));
    EXPECT_TRUE(recovery.may_open(at(3500)));
    recovery.healthy(at(4000));
    recovery.lost(at(4000));
    EXPECT_TRUE(recovery.may_open(at(4250)));
}

TEST(CameraRecovery, ASlowCameraMayBeSilentLonger) {
    CameraRecovery recovery;
    recovery.opened(at(0), milliseconds(3000));
    recovery.healthy(at(100));
    EXPECT_EQ(remedies(recovery, 100, 4000).front().first, 3100);
}

DepthFrame frame_of(std::uint16_t first, std::uint16_t rest) {
    DepthFrame frame;
    frame.depth_mm.assign(100, rest);
    frame.depth_mm[0] = first;
    return frame;
}

TEST(FrameJudge, TheSamePictureForHalfASecondIsFrozen) {
    FrameJudge judge;
    for (int i = 0; i < 15; ++i) EXPECT_EQ(judge.judge(frame_of(1, 900)), FrameHealth::good) << i;
    EXPECT_EQ(judge.judge(frame_of(1, 900)), FrameHealth::frozen);
    EXPECT_EQ(judge.judge(frame_of(2, 900)), FrameHealth::good) << "one pixel is enough";
    EXPECT_EQ(judge.judge(frame_of(2, 900)), FrameHealth::good);
}

TEST(FrameJudge, NothingSeenForHalfASecondIsBlind) {
    FrameJudge judge;
    for (int i = 0; i < 14; ++i) EXPECT_EQ(judge.judge(frame_of(0, 0)), FrameHealth::good) << i;
    EXPECT_EQ(judge.judge(frame_of(0, 0)), FrameHealth::blind);
    EXPECT_EQ(judge.judge(frame_of(500, 0)), FrameHealth::good);
}

/// Rows of 8 pixels: those before `from_row` are of this picture, the others of the last one.
DepthFrame torn_frame(std::uint16_t value, std::uint16_t last_value, int from_row) {
    DepthFrame frame;
    frame.width_px = 8;
    frame.height_px = 20;
    frame.depth_mm.assign(160, value);
    std::fill(frame.depth_mm.begin() + 8 * from_row, frame.depth_mm.end(), last_value);
    return frame;
}

TEST(FrameJudge, RowsOfThePictureBeforeAreATear) {
    FrameJudge judge;
    EXPECT_EQ(judge.judge(torn_frame(900, 900, 20)), FrameHealth::good);
    EXPECT_EQ(judge.judge(torn_frame(901, 900, 10)), FrameHealth::torn);
    EXPECT_EQ(judge.judge(torn_frame(902, 902, 20)), FrameHealth::good) << "the next whole one";
    EXPECT_EQ(judge.judge(torn_frame(903, 902, 13)), FrameHealth::good) << "a few rows are alike by chance";
    EXPECT_EQ(judge.judge(torn_frame(904, 0, 10)), FrameHealth::good);
    EXPECT_EQ(judge.judge(torn_frame(905, 0, 10)), FrameHealth::good) << "no depth there, twice";
}

/// A recording of a real room with somebody in it.
TEST(FrameJudge, ARealCameraGivesNoTornPictures) {
    const std::filesystem::path folder = TOUCHSTONE_SHARED_DIR "/data/kinect-room-person";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    FrameJudge judge;
    int frames = 0;
    for (; std::filesystem::exists(folder / fmt::format("frame-{:06}.depth.png", frames)); ++frames) {
        const Image16 picture = read_png_16(folder / fmt::format("frame-{:06}.depth.png", frames));
        DepthFrame frame;
        frame.width_px = picture.width_px;
        frame.height_px = picture.height_px;
        frame.depth_mm = picture.pixels;
        EXPECT_EQ(judge.judge(frame), FrameHealth::good) << frames;
    }
    EXPECT_GT(frames, 100);
}

TEST(SteadyTime, GoesOnOverJumpsInBothDirections) {
    SteadyTime time;
    EXPECT_EQ(time.steady_us(1000, 0), 1000U);
    EXPECT_EQ(time.steady_us(34'333, 40'000), 34'333U) << "the host's jitter is not taken over";
    EXPECT_EQ(time.steady_us(3'600'000'000, 70'000), 64'333U);
    EXPECT_EQ(time.steady_us(3'600'033'333, 100'000), 97'666U);
    EXPECT_EQ(time.steady_us(5, 150'000), 147'666U);
    EXPECT_EQ(time.jumps(), 2);
    EXPECT_EQ(time.steady_us(3'000'005, 3'150'000), 3'147'666U) << "a pause is no jump";
}

}  // namespace
}  // namespace touchstone
