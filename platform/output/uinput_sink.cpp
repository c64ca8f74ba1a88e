#include "platform/output/uinput_sink.hpp"

#include <cerrno>
#include <fmt/core.h>
#include <libevdev/libevdev-uinput.h>
#include <libevdev/libevdev.h>
#include <system_error>

#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {
namespace {

constexpr int largest_tracking_id = 65535;

void add_axis(libevdev* device, unsigned code, TouchScreenAxis axis) {
    input_absinfo info{};
    info.maximum = axis.largest;
    info.resolution = axis.units_per_mm;
    libevdev_enable_event_code(device, EV_ABS, code, &info);
}

Error cannot_make(const std::filesystem::path& node, int code) {
    return Error(ExitStatus::unavailable,
                 fmt::format("uinput: no touch screen can be made through {}: {}; {}, or switch it off: "
                             "[uinput] enabled = false",
                             node.string(), std::generic_category().message(code), uinput_advice(node)));
}

}  // namespace

void EvdevDeleter::operator()(libevdev* device) const { libevdev_free(device); }

void UinputSink::FileCloser::operator()(std::FILE* file) const { std::fclose(file); }

void UinputSink::UinputDeleter::operator()(libevdev_uinput* device) const { libevdev_uinput_destroy(device); }

EvdevDevice describe_touch_screen(const TouchScreenConfig& config) {
    const TouchScreenAxis x = touch_screen_axis(config.width_mm), y = touch_screen_axis(config.height_mm);
    EvdevDevice device(libevdev_new());
    libevdev_set_name(device.get(), touch_screen_name);
    libevdev_set_id_bustype(device.get(), BUS_VIRTUAL);
    libevdev_enable_property(device.get(), INPUT_PROP_DIRECT);
    // No BTN_LEFT: udev would take the device for a mouse as well.
    libevdev_enable_event_code(device.get(), EV_KEY, BTN_TOUCH, nullptr);
    add_axis(device.get(), ABS_X, x);
    add_axis(device.get(), ABS_Y, y);
    add_axis(device.get(), ABS_MT_POSITION_X, x);
    add_axis(device.get(), ABS_MT_POSITION_Y, y);
    add_axis(device.get(), ABS_MT_SLOT, {.largest = config.slots - 1});
    add_axis(device.get(), ABS_MT_TRACKING_ID, {.largest = largest_tracking_id});
    return device;
}

std::string uinput_advice(const std::filesystem::path& node) {
    std::error_code code;
    if (!std::filesystem::exists(node, code)) return "sudo modprobe uinput";
    return fmt::format(
        "sudo cp {} /etc/udev/rules.d/ && sudo udevadm control --reload && sudo udevadm trigger {} && sudo "
        "usermod -aG input $USER, then log in anew",
        TOUCHSTONE_UINPUT_RULES, node.string());
}

UinputSink::UinputSink(const TouchScreenConfig& config, const std::filesystem::path& node)
    : config_(config), events_(config), file_(std::fopen(node.c_str(), "r+e")) {
    if (!file_) throw cannot_make(node, errno);
    libevdev_uinput* device = nullptr;
    const int failure =
        libevdev_uinput_create_from_device(describe_touch_screen(config).get(), fileno(file_.get()), &device);
    if (failure != 0) throw cannot_make(node, -failure);
    device_.reset(device);
}

UinputSink::~UinputSink() {
    try {
        release_all();
    } catch (const Error& error) {
        log_warning("{}", error.what());
    }
}

void UinputSink::publish(const TouchReport& report) {
    write(events_.frame(report.touches));
    if (events_.left_out() == 0 || said_left_out_) return;
    said_left_out_ = true;
    log_warning("uinput: more than {} touches at once; those that came last are left out: [uinput] slots",
                config_.slots);
}

void UinputSink::release_all() { write(events_.release_all()); }

std::string UinputSink::device_node() const {
    const char* node = libevdev_uinput_get_devnode(device_.get());
    return node != nullptr ? node : "";
}

void UinputSink::write(const TouchScreenEvents::Events& events) {
    for (const InputEvent& event : events) {
        const int failure = libevdev_uinput_write_event(device_.get(), event.type, event.code, event.value);
        if (failure != 0) {
            throw Error(ExitStatus::io_error, fmt::format("uinput: the touch screen takes no event: {}",
                                                          std::generic_category().message(-failure)));
        }
    }
}

}  // namespace touchstone
