#include "platform/usb/usb_device.hpp"

#include <cstdio>
#include <exception>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "platform/usb/depth_cameras.hpp"
#include "tests/platform/usb/emulated_usb.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr unsigned nobody = 65534;
constexpr int no_other_user = 100;

class UsbDeviceTest : public ::testing::Test {
  protected:
    void SetUp() override {
        usb = std::make_unique<EmulatedUsb>();
        if (!EmulatedUsb::works()) GTEST_SKIP() << "needs umockdev's library preloaded: umockdev-wrapper";
    }
    static std::vector<UsbDepthCamera> cameras() { return find_depth_cameras(list_usb_devices()); }
    static UsbDevice only_camera() { return cameras().at(0).device; }

    std::unique_ptr<EmulatedUsb> usb;
};

/// What the camera's state is for a user who is not root.
int state_for_nobody() {
    const pid_t child = fork();
    if (child == 0) {
        if (getuid() == 0 && setuid(nobody) != 0) _exit(no_other_user);
        try {
            const auto cameras = find_depth_cameras(list_usb_devices());
            _exit(cameras.size() == 1 ? static_cast<int>(cameras[0].state) : 101);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
            _exit(102);
        }
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 103;
}

TEST_F(UsbDeviceTest, Absent) { EXPECT_THAT(cameras(), IsEmpty()); }

TEST_F(UsbDeviceTest, PresentWithWhatIsKnownOfIt) {
    usb->plug_in_kinect("1-2");
    const auto found = cameras();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].state, UsbCameraState::ready);
    const UsbDevice& camera = found[0].device;
    EXPECT_EQ(camera.name(), "1-2.3");
    EXPECT_EQ(camera.bus, 1);
    EXPECT_EQ(camera.vendor, 0x045e);
    EXPECT_EQ(camera.product, 0x02ae);
    EXPECT_EQ(camera.speed_mbit, 480);
    EXPECT_TRUE(camera.autosuspend);
    EXPECT_TRUE(camera.may_open);
}

TEST_F(UsbDeviceTest, WithoutItsPowerSupply) {
    usb->plug_in_kinect_without_power("1-2");
    const auto found = cameras();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].state, UsbCameraState::no_power);
}

TEST_F(UsbDeviceTest, PluggedInLaterPulledOutAndBackAgain) {
    EXPECT_THAT(cameras(), IsEmpty());
    usb->plug_in_kinect("2-1");
    EXPECT_EQ(cameras().size(), 1U);
    for (const char* part : {"2-1.3", "2-1.2", "2-1.1", "2-1"}) usb->pull_out(part);
    EXPECT_THAT(cameras(), IsEmpty());
    usb->plug_in_kinect("1-1");
    ASSERT_EQ(cameras().size(), 1U);
    EXPECT_EQ(only_camera().name(), "1-1.3");
}

TEST_F(UsbDeviceTest, WithoutPermission) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "ThreadSanitizer follows no threads that begin after a fork";
#endif
    usb->plug_in_kinect("1-2");
    ASSERT_EQ(chmod(usb->root().c_str(), 0777), 0);  // the emulation makes sockets there
    ASSERT_EQ(chmod(usb->real_node("1-2.3").c_str(), 0666), 0);
    const int state = state_for_nobody();
    if (state == no_other_user) GTEST_SKIP() << "this user namespace has one user only";
    EXPECT_EQ(state, static_cast<int>(UsbCameraState::ready));
    ASSERT_EQ(chmod(usb->real_node("1-2.3").c_str(), getuid() == 0 ? 0600 : 0), 0);
    EXPECT_EQ(state_for_nobody(), static_cast<int>(UsbCameraState::no_permission));
}

TEST_F(UsbDeviceTest, StaysAwakeWhenAsked) {
    usb->plug_in_kinect("1-2");
    EXPECT_TRUE(keep_awake(only_camera()));
    EXPECT_FALSE(only_camera().autosuspend);
    UsbDevice gone = only_camera();
    gone.ports = {7};
    EXPECT_FALSE(keep_awake(gone));
}

TEST_F(UsbDeviceTest, ResetOfWhatIsThereAndOfWhatIsGone) {
    usb->plug_in_kinect("1-2");
    const UsbDevice camera = only_camera();
    EXPECT_NO_THROW(reset_usb_device(camera));
    usb->pull_out("1-2.3");
    expect_error([&] { reset_usb_device(camera); }, ExitStatus::unavailable, HasSubstr("1-2.3"));
}

TEST_F(UsbDeviceTest, ManyListingsLeaveNoDescriptors) {
    usb->plug_in_kinect("1-2");
    const int before = dup(0);
    close(before);
    for (int i = 0; i < 50; ++i) list_usb_devices();
    const int after = dup(0);
    close(after);
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace touchstone
