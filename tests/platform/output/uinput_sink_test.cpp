#include "platform/output/uinput_sink.hpp"

#include <chrono>
#include <fcntl.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libevdev/libevdev.h>
#include <thread>
#include <unistd.h>

#include "tests/platform/output/touch_screen_script.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(TouchScreen, IsAMultiTouchScreenAndNoMouse) {
    const EvdevDevice screen = describe_touch_screen({.slots = 10, .width_mm = 640, .height_mm = 0});
    EXPECT_STREQ(libevdev_get_name(screen.get()), "Touchstone touch screen");
    EXPECT_TRUE(libevdev_has_property(screen.get(), INPUT_PROP_DIRECT));
    EXPECT_TRUE(libevdev_has_event_code(screen.get(), EV_KEY, BTN_TOUCH));
    EXPECT_FALSE(libevdev_has_event_code(screen.get(), EV_KEY, BTN_LEFT));
    EXPECT_FALSE(libevdev_has_event_type(screen.get(), EV_REL));
    for (const unsigned axis : {ABS_X, ABS_MT_POSITION_X}) {
        EXPECT_EQ(libevdev_get_abs_maximum(screen.get(), axis), 6400);
        EXPECT_EQ(libevdev_get_abs_resolution(screen.get(), axis), 10);
    }
    for (const unsigned axis : {ABS_Y, ABS_MT_POSITION_Y}) {
        EXPECT_EQ(libevdev_get_abs_maximum(screen.get(), axis), 32767);
        EXPECT_EQ(libevdev_get_abs_resolution(screen.get(), axis), 0);
    }
    EXPECT_EQ(libevdev_get_abs_maximum(screen.get(), ABS_MT_SLOT), 9);
    EXPECT_EQ(libevdev_get_abs_maximum(screen.get(), ABS_MT_TRACKING_ID), 65535);
}

TEST(UinputSink, SaysWhatToDoWhereThereIsNoUinput) {
    expect_error([] { UinputSink({}, "/nowhere/uinput"); }, ExitStatus::unavailable,
                 AllOf(HasSubstr("/nowhere/uinput: No such file"), HasSubstr("sudo modprobe uinput"),
                       HasSubstr("[uinput] enabled = false")));
}

TEST(UinputSink, SaysWhatToDoWhereTheNodeIsNotForThisUser) {
    const TemporaryFolder folder;
    std::ofstream(folder / "uinput") << "";
    expect_error([&] { UinputSink({}, folder / "uinput"); }, ExitStatus::unavailable,
                 AllOf(HasSubstr("70-touchstone-uinput.rules"), HasSubstr("usermod -aG input")));
}

TEST(UinputSink, TheRulesItNamesAreThere) {
    const TemporaryFolder folder;
    std::ofstream(folder / "uinput") << "";
    const std::string advice = uinput_advice(folder / "uinput");
    const std::size_t begin = advice.find('/'), end = advice.find(' ', begin);
    EXPECT_TRUE(std::filesystem::exists(advice.substr(begin, end - begin))) << advice;
}

/// Reads a device of /dev/input from its making to its end.
class EventReader {
  public:
    /// udev may still be setting the rights of the device: tried for two seconds.
    explicit EventReader(const std::string& node) {
        for (int i = 0; i < 100 && file_ < 0; ++i) {
            file_ = ::open(node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
            if (file_ < 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        libevdev* device = nullptr;
        if (file_ >= 0 && libevdev_new_from_fd(file_, &device) == 0) device_.reset(device);
    }
    ~EventReader() {
        device_.reset();
        if (file_ >= 0) ::close(file_);
    }
    EventReader(const EventReader&) = delete;
    EventReader& operator=(const EventReader&) = delete;

    bool is_open() const { return device_ != nullptr; }
    std::vector<InputEvent> take() {
        std::vector<InputEvent> events;
        input_event event{};
        while (libevdev_next_event(device_.get(), LIBEVDEV_READ_FLAG_NORMAL, &event) ==
               LIBEVDEV_READ_STATUS_SUCCESS) {
            events.push_back({event.type, event.code, event.value});
        }
        return events;
    }

  private:
    int file_ = -1;
    EvdevDevice device_;
};

TEST(UinputSink, ARealDeviceGivesTheGoldenSequence) {
    if (::access(uinput_node, R_OK | W_OK) != 0)
        GTEST_SKIP() << uinput_node << " is not there, or not for this user";
    UinputSink sink(scripted_screen);
    EventReader reader(sink.device_node());
    if (!reader.is_open()) GTEST_SKIP() << sink.device_node() << " may not be read by this user";
    for (const TouchScreenStep& step : touch_screen_script()) {
        TouchReport report;
        report.touches = step.touches;
        sink.publish(report);
        EXPECT_EQ(reader.take(), step.events) << step.what;
    }
}

}  // namespace
}  // namespace touchstone
