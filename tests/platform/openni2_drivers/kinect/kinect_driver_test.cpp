#include <OpenNI.h>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

#include "kernels/shared_types.h"
#include "platform/camera/depth_camera.hpp"
#include "platform/camera/sensor_session.hpp"
#include "platform/openni2_drivers/common/driver_properties.h"
#include "tests/platform/openni2_drivers/kinect/scripted_freenect.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
constexpr int patient_ms = 10'000;

/// OpenNI2 with the driver, over a script that begins anew.
class KinectDriverTest : public ::testing::Test {
  protected:
    void SetUp() override {
        script.devices = 1;
        script.opens = script.has_motor = script.starts = true;
        script.gone = script.own_calibration = false;
        script.raw = 800;
        script.ticks = 600;
        script.color_starts = 0;
        script.led = -1;
        script.auto_exposure = script.auto_white_balance = 1;
        script.takes_flags = true;
        script.tilt_deg = 0;
        session.emplace();
    }
    void TearDown() override {
        session.reset();
        EXPECT_EQ(script.opened, 0);
        EXPECT_EQ(script.contexts, 0);
        EXPECT_EQ(script.registrations, 0);
    }

    void open() { ASSERT_EQ(device.open("kinect:0"), openni::STATUS_OK) << error(); }
    void start(openni::VideoStream& stream, openni::SensorType sensor) {
        ASSERT_EQ(stream.create(device, sensor), openni::STATUS_OK) << error();
        ASSERT_EQ(stream.start(), openni::STATUS_OK) << error();
    }
    static std::string error() { return openni::OpenNI::getExtendedError(); }
    static openni::VideoFrameRef read(openni::VideoStream& stream) {
        openni::VideoStream* streams[] = {&stream};
        int ready = -1;
        openni::VideoFrameRef frame;
        EXPECT_EQ(openni::OpenNI::waitForAnyStream(streams, 1, &ready, patient_ms), openni::STATUS_OK);
        stream.readFrame(&frame);
        return frame;
    }
    static const std::uint16_t* depth_of(const openni::VideoFrameRef& frame) {
        return static_cast<const std::uint16_t*>(frame.getData());
    }
    template <class Condition>
    static bool becomes_true(Condition condition) {
        for (int i = 0; i < 1000; ++i) {
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }

    ScriptedFreenect& script = ScriptedFreenect::instance();
    std::optional<SensorSession> session;
    openni::Device device;
};

TEST_F(KinectDriverTest, DepthIsInMillimetresWithTheDevicesTimes) {
    open();
    openni::VideoStream depth;
    start(depth, openni::SENSOR_DEPTH);
    const openni::VideoFrameRef frame = read(depth);
    ASSERT_EQ(frame.getWidth(), 640);
    ASSERT_EQ(frame.getHeight(), 480);
    EXPECT_EQ(frame.getVideoMode().getPixelFormat(), openni::PIXEL_FORMAT_DEPTH_1_MM);
    EXPECT_EQ(depth_of(frame)[0], 0) << "raw 2047";
    EXPECT_EQ(depth_of(frame)[1], 1194) << "raw 800";
    EXPECT_EQ(frame.getTimestamp(),
              10U + static_cast<std::uint64_t>(frame.getFrameIndex() - 1) * 2'000'000 / 60);
    EXPECT_EQ(depth.getMaxPixelValue(), 10'001);
    depth.destroy();
    device.close();
}

TEST_F(KinectDriverTest, CamerasSendOnlyWhileTheirStreamsRun) {
    open();
    EXPECT_EQ(script.depth_streams + script.color_streams, 0);
    openni::VideoStream depth, color;
    start(depth, openni::SENSOR_DEPTH);
    read(depth);
    EXPECT_EQ(script.depth_streams, 1);
    EXPECT_EQ(script.color_starts, 0);
    start(color, openni::SENSOR_COLOR);
    const openni::VideoFrameRef frame = read(color);
    const auto* rgb = static_cast<const std::uint8_t*>(frame.getData());
    EXPECT_EQ(std::vector<int>(rgb, rgb + 6), (std::vector<int>{1, 2, 3, 9, 9, 9}));
    EXPECT_EQ(script.color_streams, 1);
    color.stop();
    EXPECT_EQ(script.color_streams, 0);
    EXPECT_EQ(script.depth_streams, 1);
    depth.destroy();
    EXPECT_EQ(script.depth_streams, 0);
    color.destroy();
    device.close();
}

TEST_F(KinectDriverTest, DepthCameraOpensColourOnlyWhenAsked) {
    {
        DepthCamera camera = DepthCamera::open();
        EXPECT_TRUE(camera.is_device());
        const ReadResult result = camera.read(patient_ms);
        const auto* frame = std::get_if<DepthFrame>(&result);
        ASSERT_NE(frame, nullptr);
        EXPECT_NEAR(frame->intrinsics.fx_px, 575.816F, 1e-3F);
        EXPECT_EQ(frame->depth_mm[1], 1194);
        ASSERT_NE(camera.model(), nullptr);
        EXPECT_EQ(camera.model()->name, "Kinect v1");
    }
    EXPECT_EQ(script.color_starts, 0);
    DepthCamera camera = DepthCamera::open("kinect:0", std::nullopt, true);
    camera.read(patient_ms);
    EXPECT_EQ(script.color_starts, 1);
}

TEST_F(KinectDriverTest, LostPacketsAreCounted) {
    DepthCamera camera = DepthCamera::open();
    ASSERT_TRUE(std::holds_alternative<DepthFrame>(camera.read(patient_ms)));
    const auto before = camera.lost_packets();
    ASSERT_TRUE(before);
    script.loses_packets = 3;
    EXPECT_TRUE(becomes_true([&] { return camera.lost_packets() == *before + 3; }));
    script.loses_packets = 200;
    EXPECT_TRUE(becomes_true([&] { return camera.lost_packets() == *before + 203; }));
}

TEST_F(KinectDriverTest, AModeThatItLacksIsRefusedWithThoseThatItHas) {
    CameraSetup setup;
    setup.mode = DepthMode{320, 240, 60};
    expect_error([&] { DepthCamera::open("kinect:0", std::nullopt, false, setup); }, ExitStatus::unavailable,
                 AllOf(HasSubstr("sensor.mode 320x240@60"), HasSubstr("640x480@30")));
    setup.mode = DepthMode{640, 480, 30};
    DepthCamera camera = DepthCamera::open("kinect:0", std::nullopt, false, setup);
    EXPECT_TRUE(std::holds_alternative<DepthFrame>(camera.read(patient_ms)));
}

TEST_F(KinectDriverTest, MirroringReversesRows) {
    open();
    openni::VideoStream depth, color;
    start(depth, openni::SENSOR_DEPTH);
    start(color, openni::SENSOR_COLOR);
    EXPECT_FALSE(depth.getMirroringEnabled());
    ASSERT_EQ(depth.setMirroringEnabled(true), openni::STATUS_OK);
    ASSERT_EQ(color.setMirroringEnabled(true), openni::STATUS_OK);
    EXPECT_TRUE(depth.getMirroringEnabled());
    for (int i = 0; i < 3; ++i) read(depth), read(color);  // what was under way
    const openni::VideoFrameRef frame = read(depth), picture = read(color);
    EXPECT_EQ(depth_of(frame)[0], 1194);
    EXPECT_EQ(depth_of(frame)[639], 0);
    const auto* rgb = static_cast<const std::uint8_t*>(picture.getData()) + 639 * 3;
    EXPECT_EQ(std::vector<int>(rgb, rgb + 3), (std::vector<int>{1, 2, 3}));
    depth.destroy();
    color.destroy();
    device.close();
}

TEST_F(KinectDriverTest, RegistrationMovesDepthToTheColourCamera) {
    script.own_calibration = true;
    open();
    openni::VideoStream depth;
    start(depth, openni::SENSOR_DEPTH);
    EXPECT_EQ(depth_of(read(depth))[1], 597) << "the device's own plane";
    Intrinsics k{};
    ASSERT_EQ(device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS, &k), openni::STATUS_OK);
    EXPECT_NEAR(k.fx_px, 287.908F, 1e-3F);
    EXPECT_NEAR(depth.getHorizontalFieldOfView(), 2 * std::atan(640 / (2 * 287.908)), 1e-4);
    ASSERT_TRUE(device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
    ASSERT_EQ(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), openni::STATUS_OK);
    EXPECT_EQ(device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
    for (int i = 0; i < 3; ++i) read(depth);
    const openni::VideoFrameRef frame = read(depth);
    EXPECT_EQ(depth_of(frame)[1], 0) << "moved to the right by the device's table";
    EXPECT_EQ(depth_of(frame)[2], 597);
    ASSERT_EQ(device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS, &k), openni::STATUS_OK);
    EXPECT_EQ(k.fx_px, 525.0F);
    EXPECT_NEAR(depth.getHorizontalFieldOfView(), 2 * std::atan(640 / (2 * 525.0)), 1e-4);
    depth.destroy();
    device.close();
}

TEST_F(KinectDriverTest, LightTiltAndGravity) {
    open();
    ASSERT_EQ(device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_LIGHT, int{TOUCHSTONE_LIGHT_BLINKING_GREEN}),
              openni::STATUS_OK);
    EXPECT_EQ(script.led, 4);
    EXPECT_EQ(device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_LIGHT, int{TOUCHSTONE_LIGHT_RED}),
              openni::STATUS_OK);
    EXPECT_EQ(script.led, 2);
    EXPECT_NE(device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_LIGHT, 17), openni::STATUS_OK);
    EXPECT_EQ(script.led, 2);
    ASSERT_EQ(device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_TILT, -12.5F), openni::STATUS_OK);
    float tilt_deg = 0;
    ASSERT_EQ(device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_TILT, &tilt_deg), openni::STATUS_OK);
    EXPECT_EQ(tilt_deg, -12.5F);
    EXPECT_NE(device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_TILT, 31.0F), openni::STATUS_OK);
    EXPECT_NE(device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_TILT, std::nanf("")), openni::STATUS_OK);
    TouchstoneVector gravity{};
    ASSERT_EQ(device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_GRAVITY, &gravity), openni::STATUS_OK);
    EXPECT_NEAR(gravity.y, 9.64F, 0.01F) << "down";
    EXPECT_NEAR(gravity.z, -2.275F, 0.01F) << "a camera that looks up has it behind";
    EXPECT_NEAR(gravity.x, 0.323F, 0.01F);
    device.close();
}

TEST_F(KinectDriverTest, ExposureAndWhiteBalanceAreThoseOfTheColourCamera) {
    open();
    openni::VideoStream depth, color;
    start(depth, openni::SENSOR_DEPTH);
    EXPECT_EQ(depth.getCameraSettings(), nullptr);
    start(color, openni::SENSOR_COLOR);
    openni::CameraSettings* settings = color.getCameraSettings();
    ASSERT_NE(settings, nullptr);
    EXPECT_TRUE(settings->getAutoExposureEnabled());
    ASSERT_EQ(settings->setAutoExposureEnabled(false), openni::STATUS_OK);
    EXPECT_EQ(script.auto_exposure, 0);
    EXPECT_EQ(script.auto_white_balance, 1);
    EXPECT_FALSE(settings->getAutoExposureEnabled());
    EXPECT_TRUE(settings->getAutoWhiteBalanceEnabled());
    ASSERT_EQ(settings->setAutoWhiteBalanceEnabled(false), openni::STATUS_OK);
    EXPECT_EQ(script.auto_white_balance, 0);
    script.takes_flags = false;
    EXPECT_NE(settings->setAutoExposureEnabled(true), openni::STATUS_OK);
    EXPECT_FALSE(settings->getAutoExposureEnabled()) << "the camera did not obey";
    color.destroy();
    depth.destroy();
    device.close();
}

TEST_F(KinectDriverTest, AKinectWithoutAMotorGivesDepthAndRefusesTheRest) {
    script.has_motor = false;
    open();
    EXPECT_NE(device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_LIGHT, int{TOUCHSTONE_LIGHT_RED}),
              openni::STATUS_OK);
    EXPECT_EQ(script.led, -1);
    openni::VideoStream depth;
    start(depth, openni::SENSOR_DEPTH);
    EXPECT_EQ(depth_of(read(depth))[1], 1194);
    depth.destroy();
    device.close();
}

TEST_F(KinectDriverTest, WhatCannotBeOpenedOrStartedSaysSo) {
    script.opens = false;
    expect_error([] { DepthCamera::open("kinect:0"); }, ExitStatus::unavailable,
                 HasSubstr("another program"));
    script.opens = true;
    script.starts = false;
    expect_error([] { DepthCamera::open("kinect:0"); }, ExitStatus::unavailable, HasSubstr("does not start"));
    expect_error([] { DepthCamera::open("kinect:7"); }, ExitStatus::unavailable, HasSubstr("kinect:7"));
}

TEST_F(KinectDriverTest, PluggedInLaterPulledOutMidStreamAndBackAgain) {
    script.devices = 0;
    EXPECT_TRUE(becomes_true([] { return !any_device_attached(); }));
    script.devices = 1;
    ASSERT_TRUE(becomes_true([] { return any_device_attached(); }));
    {
        DepthCamera camera = DepthCamera::open();
        ASSERT_TRUE(std::holds_alternative<DepthFrame>(camera.read(patient_ms)));
        script.devices = 0;
        script.gone = true;
        ReadResult result = camera.read(patient_ms);
        while (std::holds_alternative<DepthFrame>(result)) result = camera.read(patient_ms);
        ASSERT_TRUE(std::holds_alternative<CameraLost>(result));
        EXPECT_THAT(std::get<CameraLost>(result).reason, HasSubstr("unplugged"));
    }
    EXPECT_FALSE(any_device_attached());
    script.gone = false;
    script.devices = 1;
    ASSERT_TRUE(becomes_true([] { return any_device_attached(); }));
    DepthCamera camera = DepthCamera::open();
    EXPECT_TRUE(std::holds_alternative<DepthFrame>(camera.read(patient_ms)));
}

int count_entries(const char* folder) {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
    return count;
}

long resident_kb() {
    std::ifstream statm("/proc/self/statm");
    long size = 0, resident = 0;
    statm >> size >> resident;
    return resident * 4;
}

TEST_F(KinectDriverTest, AThousandOpenAndCloseCyclesLeaveNothingBehind) {
    const auto cycle = [this] {
        open();
        openni::VideoStream depth;
        start(depth, openni::SENSOR_DEPTH);
        depth.stop();
        depth.destroy();
        device.close();
    };
    for (int i = 0; i < 100; ++i) cycle();
    const int descriptors = count_entries("/proc/self/fd"), threads = count_entries("/proc/self/task");
    const long before_kb = resident_kb();
    for (int i = 0; i < 1000; ++i) cycle();
    EXPECT_EQ(count_entries("/proc/self/fd"), descriptors);
    EXPECT_EQ(count_entries("/proc/self/task"), threads);
// qemu 7.2 itself keeps 280 kB of every thread that has ended, even of an empty one, ThreadSanitizer 8 kB.
#if !defined(TOUCHSTONE_EMULATED) && !defined(__SANITIZE_THREAD__)
    EXPECT_LT(resident_kb() - before_kb, 2000) << "2 bytes a pixel lost once in a cycle would be 600 MB";
#endif
}

}  // namespace
}  // namespace touchstone
