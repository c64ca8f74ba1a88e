#include "platform/usb/depth_cameras.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

UsbDevice device(std::uint16_t vendor, std::uint16_t product, std::vector<int> ports, bool is_hub = false) {
    UsbDevice result;
    result.vendor = vendor;
    result.product = product;
    result.bus = 1;
    result.address = 5;
    result.ports = std::move(ports);
    result.is_hub = is_hub;
    result.may_open = true;
    return result;
}

std::vector<UsbDevice> kinect_at(const std::vector<int>& plug) {
    std::vector<UsbDevice> parts{device(0x0409, 0x005a, plug, true)};
    for (const auto& [product, port] : {std::pair{0x02b0, 1}, {0x02ad, 2}, {0x02ae, 3}}) {
        std::vector<int> ports = plug;
        ports.push_back(port);
        parts.push_back(device(0x045e, static_cast<std::uint16_t>(product), ports));
    }
    return parts;
}

TEST(DepthCamerasOnUsb, OtherDevicesAreNone) {
    const std::vector<UsbDevice> devices{device(0x1d6b, 2, {}, true), device(0x045e, 0x0040, {1}),
                                         device(0x046d, 0x0825, {2})};
    EXPECT_THAT(find_depth_cameras(devices), IsEmpty());
}

TEST(DepthCamerasOnUsb, AKinectIsOneCamera) {
    const auto cameras = find_depth_cameras(kinect_at({2}));
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].model, "Kinect v1");
    EXPECT_EQ(cameras[0].state, UsbCameraState::ready);
    EXPECT_EQ(cameras[0].device.product, 0x02ae);
    EXPECT_THAT(cameras[0].sharing, IsEmpty());
    EXPECT_EQ(problem_of(cameras[0]), "");
}

TEST(DepthCamerasOnUsb, TheMotorAloneMeansNoPowerSupply) {
    auto devices = kinect_at({2});
    devices.resize(2);
    const auto cameras = find_depth_cameras(devices);
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].state, UsbCameraState::no_power);
    EXPECT_THAT(problem_of(cameras[0]), HasSubstr("power supply"));
}

TEST(DepthCamerasOnUsb, OneOfTwoWithoutPowerIsNotTakenForTheOther) {
    auto devices = kinect_at({2});
    auto dark = kinect_at({3});
    dark.resize(2);
    devices.insert(devices.end(), dark.begin(), dark.end());
    const auto cameras = find_depth_cameras(devices);
    ASSERT_EQ(cameras.size(), 2U);
    EXPECT_EQ(cameras[0].state, UsbCameraState::ready);
    EXPECT_EQ(cameras[1].state, UsbCameraState::no_power);
    EXPECT_EQ(cameras[1].device.ports, (std::vector<int>{3, 1}));
}

TEST(DepthCamerasOnUsb, WithoutPermissionTheRuleIsNamed) {
    auto devices = kinect_at({2});
    for (UsbDevice& part : devices) part.may_open = false;
    const auto cameras = find_depth_cameras(devices);
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].state, UsbCameraState::no_permission);
    EXPECT_THAT(problem_of(cameras[0]), HasSubstr("70-touchstone-depth-cameras.rules"));
    EXPECT_THAT(problem_of(cameras[0]), HasSubstr("1-2.3"));
}

TEST(DepthCamerasOnUsb, AHubSharedWithOthersIsNoticed) {
    auto devices = kinect_at({1, 4});
    devices.push_back(device(0x05e3, 0x0608, {1}, true));
    devices.push_back(device(0x046d, 0x0825, {1, 2}));
    devices.push_back(device(0x046d, 0xc31c, {3}));
    UsbDevice on_other_bus = device(0x046d, 0x0825, {1, 3});
    on_other_bus.bus = 2;
    devices.push_back(on_other_bus);
    const auto cameras = find_depth_cameras(devices);
    ASSERT_EQ(cameras.size(), 1U);
    ASSERT_EQ(cameras[0].sharing.size(), 1U);
    EXPECT_EQ(cameras[0].sharing[0].ports, (std::vector<int>{1, 2}));
}

TEST(DepthCamerasOnUsb, XtionAndOrbbecAreKnownByVendor) {
    const std::vector<UsbDevice> devices{device(0x1d27, 0x0601, {1}), device(0x2bc5, 0x0401, {2, 1}),
                                         device(0x0bda, 0x8153, {2, 2})};
    const auto cameras = find_depth_cameras(devices);
    ASSERT_EQ(cameras.size(), 2U);
    EXPECT_THAT(cameras[0].model, HasSubstr("Xtion"));
    EXPECT_THAT(cameras[0].sharing, IsEmpty());
    EXPECT_THAT(cameras[1].model, HasSubstr("Orbbec"));
    EXPECT_THAT(cameras[1].sharing, Not(IsEmpty())) << "no hub of its own inside";
}

}  // namespace
}  // namespace touchstone
