#include "platform/openni2_drivers/common/source_device.hpp"

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mutex>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using ::testing::ElementsAre;

constexpr int width_px = 8, height_px = 4;

/// Frames 10, 11, ... whose pixels are their index.
class CountingSource : public FrameSource {
  public:
    explicit CountingSource(int frames, int fail_at = -1) : frames_(frames), fail_at_(fail_at) {
        info_.intrinsics = {10, 20, 3.5F, 1.5F, width_px, height_px, {}};
        info_.has_color = true;
        info_.color_width_px = width_px;
        info_.color_height_px = height_px;
        info_.rate_hz = 1000;
        info_.default_pace = Pace::step;
    }
    const SourceInfo& info() const override { return info_; }
    void enable_color(bool enabled) override { color_ = enabled; }
    bool next(SourceFrame& frame) override {
        if (made_ == fail_at_) throw Error(ExitStatus::bad_data, "frame 3 is damaged");
        if (made_ == frames_) return false;
        frame.index = 10 + made_++;
        frame.timestamp_us = static_cast<std::uint64_t>(frame.index) * 1000;
        frame.depth_mm.assign(width_px * height_px, static_cast<std::uint16_t>(frame.index));
        frame.color_rgb.clear();
        if (color_ && made_ % 2 == 1) frame.color_rgb.assign(3 * width_px * height_px, 200);
        return true;
    }

  private:
    SourceInfo info_;
    int frames_, fail_at_, made_ = 0;
    bool color_ = false;
};

struct Delivered {
    OniSensorType sensor;
    int index;
    std::uint64_t timestamp_us;
    int bytes;
    int first_value;
};

/// Stands for OpenNI's side of the streams: hands out one buffer and notes what comes.
class Receiver {
  public:
    Receiver() {
        OniStreamServices& c = services_;
        c.streamServices = this;
        c.getDefaultRequiredFrameSize = [](void*) { return 3 * width_px * height_px; };
        c.acquireFrame = [](void* self) { return static_cast<Receiver*>(self)->acquire(); };
        c.addFrameRef = [](void*, OniFrame*) {};
        c.releaseFrame = [](void*, OniFrame*) {};
    }
    void connect(oni::driver::StreamBase* stream) {
        stream->setServices(&services_);
        stream->setNewFrameCallback([](oni::driver::StreamBase*, OniFrame* frame,
                                       void* self) { static_cast<Receiver*>(self)->note(*frame); },
                                    this);
    }
    std::vector<Delivered> frames() {
        const std::lock_guard lock(mutex_);
        return frames_;
    }
    bool wait_for(std::size_t count) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return frames_.size() >= count; });
    }

  private:
    OniFrame* acquire() {
        frame_ = OniFrame{};
        frame_.data = buffer_;
        return &frame_;
    }
    void note(const OniFrame& frame) {
        const std::lock_guard lock(mutex_);
        std::uint16_t value = 0;
        std::memcpy(&value, frame.data, sizeof value);
        frames_.push_back({frame.sensorType, frame.frameIndex, frame.timestamp, frame.dataSize, value});
        changed_.notify_all();
    }

    oni::driver::StreamServices services_{};
    OniFrame frame_{};
    std::uint8_t buffer_[3 * width_px * height_px]{};
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Delivered> frames_;
};

struct Fixture {
    explicit Fixture(int frames, int fail_at = -1)
        : device(std::make_unique<CountingSource>(frames, fail_at),
                 [this](OniDeviceState state) { states.push_back(state); }) {}

    oni::driver::StreamBase* add(OniSensorType sensor) {
        auto* stream = device.createStream(sensor);
        receiver.connect(stream);
        return stream;
    }
    template <class T>
    T property(int id) {
        T value{};
        int size = sizeof value;
        EXPECT_EQ(device.getProperty(id, &value, &size), ONI_STATUS_OK);
        return value;
    }

    Receiver receiver;
    std::vector<OniDeviceState> states;
    SourceDevice device;
};

template <class T>
T stream_property(oni::driver::StreamBase* stream, int id) {
    T value{};
    int size = sizeof value;
    EXPECT_EQ(stream->getProperty(id, &value, &size), ONI_STATUS_OK) << "property " << id;
    return value;
}

TEST(SourceDevice, StepMakesOneFramePerTriggerInOrderAndEndsOnce) {
    Fixture f(3);
    f.add(ONI_SENSOR_DEPTH)->start();
    EXPECT_TRUE(f.receiver.frames().empty()) << "nothing comes before a reader waits";
    for (int i = 0; i < 6; ++i) f.device.tryManualTrigger();
    const auto frames = f.receiver.frames();
    ASSERT_EQ(frames.size(), 3U);
    for (int i = 0; i < 3; ++i) {
        const Delivered& frame = frames[static_cast<std::size_t>(i)];
        EXPECT_EQ(frame.sensor, ONI_SENSOR_DEPTH);
        EXPECT_EQ(frame.index, 10 + i);
        EXPECT_EQ(frame.timestamp_us, (10U + static_cast<unsigned>(i)) * 1000U);
        EXPECT_EQ(frame.first_value, 10 + i);
        EXPECT_EQ(frame.bytes, 2 * width_px * height_px);
    }
    EXPECT_THAT(f.states, ElementsAre(ONI_DEVICE_STATE_EOF));
}

TEST(SourceDevice, ColorGoesBeforeDepthAndIsEmptyWhereThereIsNone) {
    Fixture f(2);
    f.add(ONI_SENSOR_DEPTH)->start();
    f.add(ONI_SENSOR_COLOR)->start();
    f.device.tryManualTrigger();
    f.device.tryManualTrigger();
    const auto frames = f.receiver.frames();
    ASSERT_EQ(frames.size(), 4U);
    EXPECT_EQ(frames[0].sensor, ONI_SENSOR_COLOR);
    EXPECT_EQ(frames[0].bytes, 3 * width_px * height_px);
    EXPECT_EQ(frames[1].sensor, ONI_SENSOR_DEPTH);
    EXPECT_EQ(frames[2].sensor, ONI_SENSOR_COLOR);
    EXPECT_EQ(frames[2].bytes, 0);
    EXPECT_EQ(frames[2].first_value, 0) << "no pixels of an older picture are left";
    EXPECT_EQ(frames[2].index, frames[3].index);
    EXPECT_EQ(frames[2].timestamp_us, frames[3].timestamp_us);
}

TEST(SourceDevice, AStoppedStreamGetsNothing) {
    Fixture f(3);
    f.add(ONI_SENSOR_DEPTH)->start();
    auto* color = f.add(ONI_SENSOR_COLOR);
    color->start();
    color->stop();
    f.device.tryManualTrigger();
    ASSERT_EQ(f.receiver.frames().size(), 1U);
    EXPECT_EQ(f.receiver.frames()[0].sensor, ONI_SENSOR_DEPTH);
}

TEST(SourceDevice, BadDataInMidStreamIsAStateAndAProperty) {
    Fixture f(5, 2);
    f.add(ONI_SENSOR_DEPTH)->start();
    EXPECT_EQ(f.property<TouchstoneDriverError>(TOUCHSTONE_DEVICE_PROPERTY_LAST_ERROR).exit_status, 0);
    for (int i = 0; i < 4; ++i) f.device.tryManualTrigger();
    EXPECT_EQ(f.receiver.frames().size(), 2U);
    EXPECT_THAT(f.states, ElementsAre(ONI_DEVICE_STATE_ERROR));
    const auto error = f.property<TouchstoneDriverError>(TOUCHSTONE_DEVICE_PROPERTY_LAST_ERROR);
    EXPECT_EQ(error.exit_status, 65);
    EXPECT_STREQ(error.message, "frame 3 is damaged");
}

TEST(SourceDevice, LiveRunsByItselfAndIgnoresTriggers) {
    Fixture f(50);
    const int live = TOUCHSTONE_PACE_LIVE;
    ASSERT_EQ(f.device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_PACE, &live, sizeof live), ONI_STATUS_OK);
    auto* depth = f.add(ONI_SENSOR_DEPTH);
    depth->start();
    f.device.tryManualTrigger();
    ASSERT_TRUE(f.receiver.wait_for(50));
    depth->stop();
    const auto frames = f.receiver.frames();
    ASSERT_EQ(frames.size(), 50U);
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].index, 10 + static_cast<int>(i));
}

TEST(SourceDevice, LiveStopsWithItsStreamAndCanStartAgain) {
    Fixture f(1000000);
    const int live = TOUCHSTONE_PACE_LIVE;
    f.device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_PACE, &live, sizeof live);
    auto* depth = f.add(ONI_SENSOR_DEPTH);
    for (std::size_t round = 1; round <= 3; ++round) {
        const std::size_t before = f.receiver.frames().size();
        depth->start();
        ASSERT_TRUE(f.receiver.wait_for(before + 1));
        depth->stop();
        const std::size_t stopped_at = f.receiver.frames().size();
        f.device.tryManualTrigger();
        EXPECT_EQ(f.receiver.frames().size(), stopped_at);
    }
}

TEST(SourceDevice, PaceIsFixedWhileAStreamRuns) {
    Fixture f(5);
    EXPECT_EQ(f.property<int>(TOUCHSTONE_DEVICE_PROPERTY_PACE), TOUCHSTONE_PACE_STEP)
        << "the source's default";
    auto* depth = f.add(ONI_SENSOR_DEPTH);
    depth->start();
    const int live = TOUCHSTONE_PACE_LIVE, nonsense = 7;
    EXPECT_EQ(f.device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_PACE, &live, sizeof live),
              ONI_STATUS_OUT_OF_FLOW);
    depth->stop();
    EXPECT_EQ(f.device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_PACE, &live, 2), ONI_STATUS_BAD_PARAMETER);
    EXPECT_EQ(f.device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_PACE, &nonsense, sizeof nonsense),
              ONI_STATUS_BAD_PARAMETER);
    EXPECT_EQ(f.device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_PACE, &live, sizeof live), ONI_STATUS_OK);
}

TEST(SourceDevice, StreamsDescribeThemselves) {
    Fixture f(1);
    auto* depth = f.add(ONI_SENSOR_DEPTH);
    const auto mode = stream_property<OniVideoMode>(depth, ONI_STREAM_PROPERTY_VIDEO_MODE);
    EXPECT_EQ(mode.pixelFormat, ONI_PIXEL_FORMAT_DEPTH_1_MM);
    EXPECT_EQ(mode.resolutionX, width_px);
    EXPECT_EQ(mode.resolutionY, height_px);
    EXPECT_EQ(mode.fps, 1000);
    EXPECT_NEAR(stream_property<float>(depth, ONI_STREAM_PROPERTY_HORIZONTAL_FOV), 2 * std::atan(8 / 20.0),
                1e-6);
    EXPECT_NEAR(stream_property<float>(depth, ONI_STREAM_PROPERTY_VERTICAL_FOV), 2 * std::atan(4 / 40.0),
                1e-6);
    EXPECT_EQ(stream_property<int>(depth, ONI_STREAM_PROPERTY_STRIDE), 2 * width_px);
    EXPECT_EQ(stream_property<OniBool>(depth, ONI_STREAM_PROPERTY_MIRRORING), FALSE);
    EXPECT_GE(stream_property<int>(depth, ONI_STREAM_PROPERTY_MAX_VALUE), 10000);
    EXPECT_EQ(depth->isPropertySupported(ONI_STREAM_PROPERTY_CROPPING), FALSE);
    EXPECT_EQ(depth->setProperty(ONI_STREAM_PROPERTY_VIDEO_MODE, &mode, sizeof mode), ONI_STATUS_OK);
    const OniBool mirrored = TRUE;
    EXPECT_NE(depth->setProperty(ONI_STREAM_PROPERTY_MIRRORING, &mirrored, sizeof mirrored), ONI_STATUS_OK);
    const auto k = f.property<Intrinsics>(TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS);
    EXPECT_FLOAT_EQ(k.cx_px, 3.5F);
    EXPECT_EQ(f.device.createStream(ONI_SENSOR_IR), nullptr);
}

}  // namespace
}  // namespace touchstone
