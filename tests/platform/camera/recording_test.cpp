#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "platform/camera/depth_camera.hpp"
#include "tests/platform/camera/camera_fixtures.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

std::string captured() { return shared_data("openni-desk/Captured.oni"); }

TEST(Recording, TheStockLibrarysPicturesInEachPace) {
    if (!std::filesystem::exists(captured())) GTEST_SKIP() << "no " << captured();
    for (const Pace pace : {Pace::step, Pace::live}) {
        for (const bool color : {false, true}) {
            DepthCamera camera = DepthCamera::open(captured(), pace, color);
            EXPECT_EQ(camera.has_color(), color);
            EXPECT_NEAR(camera.intrinsics().fx_px, 575.8, 0.1);
            EXPECT_FLOAT_EQ(camera.intrinsics().cx_px, 319.5F);
            const auto frames = read_to_end(camera);
            if (pace == Pace::step) {
                ASSERT_EQ(frames.size(), 4U);
            }
            for (const DepthFrame& frame : frames) {
                const int number = frame.index - 1;
                const auto expected =
                    read_png_16(shared_data(fmt::format("openni-desk/depth-{}.png", number)));
                EXPECT_EQ(frame.depth_mm, expected.pixels);
                EXPECT_EQ(frame.color_rgb.size(), color ? 3 * frame.depth_mm.size() : 0);
            }
        }
    }
}

TEST(Recording, LockStepLosesNoFrameOfARecording) {
    if (!std::filesystem::exists(captured())) GTEST_SKIP() << "no " << captured();
    for (int round = 0; round < 20; ++round) {
        DepthCamera camera = DepthCamera::open(captured(), Pace::step, round % 2 == 0);
        ASSERT_EQ(read_to_end(camera).size(), 4U) << "round " << round;
    }
}

TEST(Recording, MissingAndOtherFilesHaveTheirStatus) {
    const TemporaryFolder folder;
    expect_error([&] { DepthCamera::open(folder / "none.oni"); }, ExitStatus::no_input,
                 HasSubstr("none.oni"));
    std::ofstream(folder / "text.oni") << "this is no recording";
    expect_error([&] { DepthCamera::open(folder / "text.oni"); }, ExitStatus::bad_data,
                 HasSubstr("text.oni"));
    std::ofstream(folder / "empty.oni").close();
    expect_error([&] { DepthCamera::open(folder / "empty.oni"); }, ExitStatus::bad_data,
                 HasSubstr("empty.oni"));
}

TEST(Recording, RoundTripThroughTheStockRecorderAndPlayerKeepsEveryDepth) {
    constexpr int count = 60;
    for (const bool color : {false, true}) {
        const TemporaryFolder folder;
        write_sequence(folder, count, true);
        const std::string path = folder / "a.oni";
        {
            DepthCamera camera = DepthCamera::open(sequence_uri(folder), Pace::step, color);
            camera.start_recording(path);
            ASSERT_EQ(read_to_end(camera).size(), static_cast<std::size_t>(count));
        }
        DepthCamera replay = DepthCamera::open(path, Pace::step, color);
        EXPECT_EQ(replay.has_color(), color);
        EXPECT_NEAR(replay.intrinsics().fx_px, 575.8 * 32 / 640, 1e-3);
        const auto frames = read_to_end(replay);
        ASSERT_EQ(frames.size(), static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) {
            const DepthFrame& frame = frames[static_cast<std::size_t>(i)];
            EXPECT_EQ(frame.depth_mm, numbered_picture(i).pixels) << "frame " << i;
            EXPECT_EQ(frame.timestamp_us, static_cast<std::uint64_t>(i) * 1'000'000 / 30)
                << "times start at 0";
            if (color) {
                ASSERT_FALSE(frame.color_rgb.empty());
                EXPECT_NEAR(frame.color_rgb[0], i, 4) << "JPEG changes colours by little";
            }
        }
    }
}

TEST(Recording, DepthsUpTo65534SurviveTheRoundTrip) {
    const TemporaryFolder folder;
    write_png(folder / depth_name(0), Image16{4, 2, {1, 65534, 0, 10000, 10001, 32768, 50000, 65533}});
    write_png(folder / depth_name(1), Image16{4, 2, {2, 3, 4, 5, 6, 7, 8, 65534}});
    const std::string path = folder / "a.oni";
    {
        DepthCamera camera = DepthCamera::open(sequence_uri(folder));
        camera.start_recording(path);
        ASSERT_EQ(read_to_end(camera).size(), 2U);
        camera.stop_recording();
    }
    DepthCamera replay = DepthCamera::open(path);
    const auto frames = read_to_end(replay);
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[0].depth_mm, read_png_16(folder / depth_name(0)).pixels);
    EXPECT_EQ(frames[1].depth_mm, read_png_16(folder / depth_name(1)).pixels);
}

TEST(Recording, AnUnwritableFileIsIoError) {
    const TemporaryFolder folder;
    write_sequence(folder, 1);
    DepthCamera camera = DepthCamera::open(sequence_uri(folder));
    expect_error([&] { camera.start_recording("/nonexistent/a.oni"); }, ExitStatus::io_error,
                 HasSubstr("/nonexistent/a.oni"));
    EXPECT_EQ(read_to_end(camera).size(), 1U) << "the camera goes on";
}

}  // namespace
}  // namespace touchstone
