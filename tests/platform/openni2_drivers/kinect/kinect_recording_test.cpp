#include <OpenNI.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "platform/camera/sensor_session.hpp"
#include "platform/image/png_file.hpp"
#include "platform/openni2_drivers/common/driver_properties.h"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

constexpr int recorded_frames = 150;

/// Keeps every frame that comes, with the time of the device.
class Collector : public openni::VideoStream::NewFrameListener {
  public:
    void onNewFrame(openni::VideoStream& stream) override {
        openni::VideoFrameRef frame;
        stream.readFrame(&frame);
        const auto* mm = static_cast<const std::uint16_t*>(frame.getData());
        const std::lock_guard lock(mutex_);
        if (pictures_.size() < recorded_frames) {
            times_us_.push_back(frame.getTimestamp());
            pictures_.emplace_back(mm, mm + frame.getWidth() * frame.getHeight());
        }
    }
    std::size_t count() {
        const std::lock_guard lock(mutex_);
        return pictures_.size();
    }
    std::vector<std::uint64_t> times_us_;
    std::vector<std::vector<std::uint16_t>> pictures_;

  private:
    std::mutex mutex_;
};

std::vector<std::uint32_t> recorded_ticks(const std::string& folder) {
    std::ifstream file(folder + "/depth_times.txt");
    std::vector<std::uint32_t> ticks;
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string frame, name;
        double host_s = 0;
        std::uint32_t tick = 0;
        if (words >> frame >> name >> host_s >> tick && frame != "#") ticks.push_back(tick);
    }
    return ticks;
}

/// Debian's player of recordings in the place of libfreenect: the library that is loaded first under a name
/// is the one that all later ones get.
bool load_player() { return dlopen(TOUCHSTONE_FAKENECT_LIBRARY, RTLD_NOW | RTLD_GLOBAL) != nullptr; }

TEST(KinectRecording, AllFramesHaveTheMillimetresOfTheirPictures) {
    const std::string folder = std::string(TOUCHSTONE_SHARED_DIR) + "/data/kinect-room-person";
    if (!std::filesystem::exists(folder + "/fakenect-150.tar.xz"))
        GTEST_SKIP() << "no recording beside the checkout: " << folder;
    const TemporaryFolder unpacked;
    ASSERT_EQ(std::system(fmt::format("tar -xJf '{}/fakenect-150.tar.xz' -C '{}' --strip-components=1",
                                      folder, unpacked.path().string())
                              .c_str()),
              0);
    setenv("FAKENECT_PATH", unpacked.path().c_str(), 1);
    ASSERT_TRUE(load_player()) << dlerror();
    const SensorSession session;
    openni::Device device;
    ASSERT_EQ(device.open("kinect:0"), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
    openni::VideoStream depth;
    ASSERT_EQ(depth.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
    Collector collector;
    depth.addNewFrameListener(&collector);
    ASSERT_EQ(depth.start(), openni::STATUS_OK);
    std::size_t before = 0;
    int still = 0;
    for (int i = 0; i < 120 && collector.count() < recorded_frames && still < 10; ++i) {
        std::this_thread::sleep_for(std::chrono::seconds(1));
        still = collector.count() == before && before > 0 ? still + 1 : 0;
        before = collector.count();
    }
    TouchstoneVector gravity{};
    EXPECT_EQ(device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_GRAVITY, &gravity), openni::STATUS_OK);
    EXPECT_NEAR(gravity.y, 9.64F, 0.3F) << "the recorded camera stood upright";
    depth.removeNewFrameListener(&collector);
    depth.destroy();
    device.close();

    // OpenNI2 keeps the latest frame only: a machine that is busy with other tests loses some.
    ASSERT_GE(collector.count(), static_cast<std::size_t>(recorded_frames / 2));
    const auto ticks = recorded_ticks(folder);
    RecordProperty("frames", static_cast<int>(collector.count()));
    ASSERT_GE(ticks.size(), static_cast<std::size_t>(recorded_frames));
    for (std::size_t taken = 0; taken < collector.count(); ++taken) {
        const auto found = std::find_if(ticks.begin(), ticks.end(), [&](std::uint32_t tick) {
            return tick / 60 == collector.times_us_[taken];
        });
        ASSERT_NE(found, ticks.end()) << "a time that was not recorded, frame " << taken;
        const auto i = static_cast<std::size_t>(found - ticks.begin());
        const Image16 expected = read_png_16(fmt::format("{}/frame-{:06d}.depth.png", folder, i));
        EXPECT_TRUE(collector.pictures_[taken] == expected.pixels) << "frame " << i;
    }
}

}  // namespace
}  // namespace touchstone
