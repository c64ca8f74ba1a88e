#include "platform/camera/depth_camera.hpp"

#include <OpenNI.h>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <thread>

#include "platform/camera/sensor_session.hpp"
#include "tests/platform/camera/camera_fixtures.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

int open_descriptors() {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
    return count;
}

TEST(DepthCamera, LoadsOpenni2FromTheFolderWithOurDrivers) {
    const SensorSession session;
    std::ifstream maps("/proc/self/maps");
    std::string line, modules;
    while (std::getline(maps, line)) {
        if (line.find("libTouchstone") != std::string::npos) modules += line + "\n";
    }
    EXPECT_THAT(modules, HasSubstr("openni2/OpenNI2/Drivers/libTouchstoneSequence.so.0"));
}

TEST(DepthCamera, LockStepHandsOverEveryFrameInOrderToASlowReader) {
    const TemporaryFolder folder;
    write_sequence(folder, 100);
    DepthCamera camera = DepthCamera::open(sequence_uri(folder));
    EXPECT_EQ(camera.pace(), Pace::step);
    EXPECT_FALSE(camera.is_device());
    for (int index = 0; index < 100; ++index) {
        if (index % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        const ReadResult result = camera.read(patient_ms);
        const auto* frame = std::get_if<DepthFrame>(&result);
        ASSERT_NE(frame, nullptr);
        EXPECT_EQ(frame->index, index);
        EXPECT_EQ(frame->timestamp_us, static_cast<std::uint64_t>(index) * 1'000'000 / 30);
        EXPECT_EQ(frame->width_px, 32);
        EXPECT_EQ(frame->height_px, 24);
        EXPECT_EQ(frame->depth_mm, numbered_picture(index).pixels);
        EXPECT_TRUE(frame->color_rgb.empty());
    }
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::holds_alternative<StreamEnd>(camera.read(patient_ms)));
}

TEST(DepthCamera, ColorComesWithItsOwnDepthFrame) {
    const TemporaryFolder folder;
    write_sequence(folder, 40, true);
    std::filesystem::remove(folder / color_name(7));
    DepthCamera camera = DepthCamera::open(sequence_uri(folder), std::nullopt, true);
    EXPECT_TRUE(camera.has_color());
    const auto frames = read_to_end(camera);
    ASSERT_EQ(frames.size(), 40U);
    for (int index = 0; index < 40; ++index) {
        const DepthFrame& frame = frames[static_cast<std::size_t>(index)];
        EXPECT_EQ(frame.index, index);
        EXPECT_EQ(frame.depth_mm, numbered_picture(index).pixels);
        if (index == 7) {
            EXPECT_TRUE(frame.color_rgb.empty()) << "no other frame's colour in its place";
        } else {
            EXPECT_EQ(frame.color_rgb, numbered_color(index).pixels);
        }
    }
}

TEST(DepthCamera, ColorOfAnotherSizeIsScaledToTheDepth) {
    const TemporaryFolder folder;
    write_png(folder / depth_name(0), numbered_picture(0, 4, 2));
    write_png(folder / color_name(0), Image8{2, 1, 3, {1, 2, 3, 4, 5, 6}});
    DepthCamera camera = DepthCamera::open(sequence_uri(folder), std::nullopt, true);
    const auto frames = read_to_end(camera);
    ASSERT_EQ(frames.size(), 1U);
    const std::vector<std::uint8_t> expected{1, 2, 3, 1, 2, 3, 4, 5, 6, 4, 5, 6,
                                             1, 2, 3, 1, 2, 3, 4, 5, 6, 4, 5, 6};
    EXPECT_EQ(frames[0].color_rgb, expected);
}

TEST(DepthCamera, ColorsCanBeWatchedForAWhile) {
    const TemporaryFolder folder;
    write_sequence(folder, 12, true);
    DepthCamera camera = DepthCamera::open(sequence_uri(folder), Pace::step, false);
    EXPECT_TRUE(camera.can_see_color());
    for (int index = 0; index < 12; ++index) {
        if (index == 4) camera.watch_color(true);
        if (index == 8) camera.watch_color(false);
        const bool watched = index >= 4 && index < 8;
        EXPECT_EQ(camera.has_color(), watched);
        const ReadResult result = camera.read(patient_ms);
        const auto* frame = std::get_if<DepthFrame>(&result);
        ASSERT_NE(frame, nullptr);
        EXPECT_EQ(frame->index, index);
        EXPECT_EQ(frame->color_rgb, watched ? numbered_color(index).pixels : std::vector<std::uint8_t>())
            << index;
    }
}

TEST(DepthCamera, ColorsThatAreWantedAlwaysStay) {
    const TemporaryFolder folder;
    write_sequence(folder, 2, true);
    DepthCamera camera = DepthCamera::open(sequence_uri(folder), Pace::step, true);
    camera.watch_color(true);
    camera.watch_color(false);
    EXPECT_TRUE(camera.has_color());
}

TEST(DepthCamera, WhereThereIsNoColourNoneIsWatched) {
    const TemporaryFolder folder;
    write_sequence(folder, 2);
    DepthCamera blind = DepthCamera::open(sequence_uri(folder), Pace::step, false);
    EXPECT_FALSE(blind.can_see_color());
    blind.watch_color(true);
    EXPECT_FALSE(blind.has_color());
}

/// What another program that has the same camera open sees.
class ColorSettings {
  public:
    explicit ColorSettings(const char* uri) {
        EXPECT_EQ(device_.open(uri), openni::STATUS_OK);
        EXPECT_EQ(color_.create(device_, openni::SENSOR_COLOR), openni::STATUS_OK);
    }
    ~ColorSettings() {
        color_.destroy();
        device_.close();
    }
    bool are_automatic() {
        const auto& settings = *color_.getCameraSettings();
        EXPECT_EQ(settings.getAutoExposureEnabled(), settings.getAutoWhiteBalanceEnabled());
        return settings.getAutoExposureEnabled();
    }

  private:
    openni::Device device_;
    openni::VideoStream color_;
};

TEST(DepthCamera, ExposureIsHeldUntilItIsReleasedOrTheCameraGoes) {
    const SensorSession session;
    const char* const uri = "sim:flat?hands=0";
    ColorSettings settings(uri);
    EXPECT_TRUE(settings.are_automatic());
    {
        DepthCamera camera = DepthCamera::open(uri, Pace::step, false);
        EXPECT_FALSE(camera.hold_exposure()) << "no colours are watched";
        camera.watch_color(true);
        EXPECT_TRUE(camera.hold_exposure());
        EXPECT_FALSE(settings.are_automatic());
        camera.release_exposure();
        EXPECT_TRUE(settings.are_automatic());
        EXPECT_TRUE(camera.hold_exposure());
        camera.watch_color(false);
        EXPECT_TRUE(settings.are_automatic()) << "nothing is held that is not watched";
    }
    try {
        DepthCamera camera = DepthCamera::open(uri, Pace::step, true);
        EXPECT_TRUE(camera.hold_exposure());
        EXPECT_FALSE(settings.are_automatic());
        throw Error(ExitStatus::bad_data, "something fails while stripes are shown");
    } catch (const Error&) {
        EXPECT_TRUE(settings.are_automatic());
    }
}

TEST(DepthCamera, ACameraThatHoldsNothingSaysSo) {
    const TemporaryFolder folder;
    write_sequence(folder, 2, true);
    DepthCamera camera = DepthCamera::open(sequence_uri(folder), Pace::step, true);
    EXPECT_FALSE(camera.hold_exposure());
}

TEST(DepthCamera, LivePaceDropsRatherThanQueues) {
    const TemporaryFolder folder;
    write_sequence(folder, 60);
    DepthCamera camera = DepthCamera::open(sequence_uri(folder), Pace::live);
    EXPECT_EQ(camera.pace(), Pace::live);
    ReadResult first = camera.read(patient_ms);
    ASSERT_TRUE(std::holds_alternative<DepthFrame>(first));
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    ReadResult second = camera.read(patient_ms);
    ASSERT_TRUE(std::holds_alternative<DepthFrame>(second));
    const int skipped = std::get<DepthFrame>(second).index - std::get<DepthFrame>(first).index;
    EXPECT_GT(skipped, 1) << "a queue would hand over the next frame";
    const auto rest = read_to_end(camera);
    ASSERT_FALSE(rest.empty());
    EXPECT_EQ(rest.back().index, 59) << "the last frame waits for its reader";
    EXPECT_LT(rest.size(), 58U);
}

TEST(DepthCamera, IntrinsicsAreExact) {
    const TemporaryFolder folder;
    write_sequence(folder, 1);
    std::ofstream(folder / "camera-intrinsics.txt") << "517.3 0 318.6\n0 516.5 255.3\n0 0 1\n";
    DepthCamera camera = DepthCamera::open(sequence_uri(folder));
    EXPECT_EQ(camera.intrinsics().fx_px, 517.3F);
    EXPECT_EQ(camera.intrinsics().fy_px, 516.5F);
    EXPECT_EQ(camera.intrinsics().cx_px, 318.6F);
    EXPECT_EQ(camera.intrinsics().cy_px, 255.3F);
    EXPECT_EQ(camera.intrinsics().width_px, 32);
    EXPECT_EQ(camera.rate_hz(), 30);
    const auto frames = read_to_end(camera);
    EXPECT_EQ(frames.at(0).intrinsics.cx_px, 318.6F);
}

TEST(DepthCamera, ErrorsAtOpenKeepTheirStatusAndNameTheFile) {
    const TemporaryFolder folder;
    const SensorSession session;
    expect_error([&] { DepthCamera::open("seq:/nonexistent"); }, ExitStatus::no_input,
                 HasSubstr("/nonexistent"));
    expect_error([&] { DepthCamera::open(sequence_uri(folder)); }, ExitStatus::no_input,
                 HasSubstr("no frames"));
    std::ofstream(folder / depth_name(0)) << "no picture";
    expect_error([&] { DepthCamera::open(sequence_uri(folder)); }, ExitStatus::bad_data,
                 HasSubstr(depth_name(0)));
    expect_error([&] { DepthCamera::open(folder.path().string()); }, ExitStatus::usage, HasSubstr("seq:"));
    expect_error([&] { DepthCamera::open("no-such-device"); }, ExitStatus::unavailable,
                 HasSubstr("no-such-device"));
}

TEST(DepthCamera, BadDataInMidStreamEndsTheReadingWithItsStatus) {
    const TemporaryFolder folder;
    write_sequence(folder, 3);
    std::filesystem::resize_file(folder / depth_name(2),
                                 std::filesystem::file_size(folder / depth_name(2)) / 2);
    DepthCamera camera = DepthCamera::open(sequence_uri(folder));
    for (int index = 0; index < 2; ++index) {
        ASSERT_TRUE(std::holds_alternative<DepthFrame>(camera.read(patient_ms)));
    }
    expect_error([&] { camera.read(patient_ms); }, ExitStatus::bad_data, HasSubstr(depth_name(2)));
    expect_error([&] { camera.read(patient_ms); }, ExitStatus::bad_data, HasSubstr(depth_name(2)));
}

TEST(DepthCamera, PathsLongerThanAUriWorkAndAreNamedInFull) {
    const TemporaryFolder folder;
    const auto deep = folder.path() / std::string(200, 'a') / std::string(200, 'b');
    std::filesystem::create_directories(deep);
    const std::string uri = "seq:" + deep.string();
    write_png(deep / depth_name(4), numbered_picture(4));
    {
        DepthCamera camera = DepthCamera::open(uri);
        const auto frames = read_to_end(camera);
        ASSERT_EQ(frames.size(), 1U);
        EXPECT_EQ(frames[0].index, 4);
    }
    std::filesystem::resize_file(deep / depth_name(4), 40);
    expect_error([&] { DepthCamera::open(uri); }, ExitStatus::bad_data,
                 HasSubstr((deep / depth_name(4)).string()));
    expect_error([&] { DepthCamera::open("sim:flat?" + std::string(300, 'x')); }, ExitStatus::usage,
                 HasSubstr("255"));
}

TEST(DepthCamera, OpensAndClosesAgainAndAgain) {
    const TemporaryFolder folder;
    write_sequence(folder, 2, true);
    const SensorSession session;
    int after_first = 0;
    for (int i = 0; i < 50; ++i) {
        DepthCamera camera =
            DepthCamera::open(sequence_uri(folder), i % 2 == 0 ? Pace::step : Pace::live, true);
        ASSERT_TRUE(std::holds_alternative<DepthFrame>(camera.read(patient_ms)));
        if (i == 1) after_first = open_descriptors();
    }
    EXPECT_LE(open_descriptors(), after_first);
}

TEST(DepthCamera, ADifferentCameraAfterAnother) {
    const TemporaryFolder first, second;
    write_sequence(first, 3);
    write_sequence(second, 5);
    DepthCamera camera = DepthCamera::open(sequence_uri(first));
    EXPECT_EQ(read_to_end(camera).size(), 3U);
    camera = DepthCamera::open(sequence_uri(second));
    EXPECT_EQ(read_to_end(camera).size(), 5U);
}

TEST(DepthCamera, FilesOpenedBeforeAreNoAttachedDevice) {
    if (any_device_attached()) GTEST_SKIP() << "a real camera is attached";
    const TemporaryFolder folder;
    write_sequence(folder, 1);
    const DepthCamera camera = DepthCamera::open(sequence_uri(folder));
    EXPECT_FALSE(any_device_attached());
    EXPECT_FALSE(wait_for_device(std::chrono::milliseconds(1)));
    expect_error([&] { DepthCamera::open(); }, ExitStatus::unavailable,
                 AllOf(HasSubstr("no depth camera"), HasSubstr("--sensor")));
}

TEST(DepthCamera, RealRecordingsOfEachLayout) {
    for (const auto& [name, first_index, color] : {std::tuple{"kinect-room-person", 0, false},
                                                   {"redkitchen-000-299", 0, true},
                                                   {"tum-fr1-rpy-000-119", 0, true}}) {
        if (!std::filesystem::exists(shared_data(name))) GTEST_SKIP() << "no " << shared_data(name);
        DepthCamera camera = DepthCamera::open("seq:" + shared_data(name), Pace::step, true);
        for (int i = 0; i < 5; ++i) {
            const ReadResult result = camera.read(patient_ms);
            const auto* frame = std::get_if<DepthFrame>(&result);
            ASSERT_NE(frame, nullptr) << name;
            EXPECT_EQ(frame->index, first_index + i) << name;
            EXPECT_EQ(frame->depth_mm.size(), 640U * 480U) << name;
            EXPECT_EQ(!frame->color_rgb.empty(), color) << name;
        }
    }
}

TEST(DepthCamera, TumTimesAndMillimetres) {
    const std::string folder = shared_data("tum-fr1-rpy-000-119");
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    DepthCamera camera = DepthCamera::open("seq:" + folder);
    const ReadResult result = camera.read(patient_ms);
    const auto& frame = std::get<DepthFrame>(result);
    EXPECT_EQ(frame.timestamp_us, 1305031229528784U);
    const Image16 raw = read_png_16(folder + "/depth/1305031229.528784.png");
    for (std::size_t i = 0; i < raw.pixels.size(); ++i) {
        ASSERT_NEAR(frame.depth_mm[i], raw.pixels[i] / 5.0, 0.5) << "pixel " << i;
    }
}

}  // namespace
}  // namespace touchstone
