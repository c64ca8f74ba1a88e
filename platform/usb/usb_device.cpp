#include "platform/usb/usb_device.hpp"

#include <array>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <fstream>
#include <libusb.h>
#include <memory>
#include <span>
#include <unistd.h>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr int deepest_port = 7;  // of the USB specification

Error usb_error(const std::string& what, int code) {
    return Error(ExitStatus::unavailable, fmt::format("{}: {}", what, libusb_strerror(code)));
}

/// libusb's list of devices, read when it is made.
class DeviceList {
  public:
    DeviceList() {
        libusb_context* context = nullptr;
        if (const int code = libusb_init(&context); code < 0) throw usb_error("cannot read USB", code);
        context_.reset(context);
        libusb_device** devices = nullptr;
        const ssize_t count = libusb_get_device_list(context, &devices);
        if (count < 0) throw usb_error("cannot list USB", static_cast<int>(count));
        devices_.reset(devices);
        count_ = static_cast<std::size_t>(count);
    }
    std::span<libusb_device*> devices() const { return {devices_.get(), count_}; }

  private:
    struct Exit {
        void operator()(libusb_context* context) const { libusb_exit(context); }
    };
    struct Free {
        void operator()(libusb_device** devices) const { libusb_free_device_list(devices, 1); }
    };
    std::unique_ptr<libusb_context, Exit> context_;
    std::unique_ptr<libusb_device*, Free> devices_;
    std::size_t count_ = 0;
};

int megabits(int speed) {
    switch (speed) {
        case LIBUSB_SPEED_LOW:
        case LIBUSB_SPEED_FULL:
            return 12;
        case LIBUSB_SPEED_HIGH:
            return 480;
        case LIBUSB_SPEED_SUPER:
            return 5000;
        case LIBUSB_SPEED_SUPER_PLUS:
            return 10000;
        default:
            return 0;
    }
}

std::string power_control(const UsbDevice& device) {
    return fmt::format("/sys/bus/usb/devices/{}/power/control", device.name());
}

UsbDevice describe(libusb_device* device) {
    UsbDevice result;
    libusb_device_descriptor descriptor{};
    libusb_get_device_descriptor(device, &descriptor);
    result.vendor = descriptor.idVendor;
    result.product = descriptor.idProduct;
    result.bus = libusb_get_bus_number(device);
    result.address = libusb_get_device_address(device);
    std::array<std::uint8_t, deepest_port> ports{};
    const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
    if (depth > 0) result.ports.assign(ports.begin(), ports.begin() + depth);
    result.is_hub = descriptor.bDeviceClass == LIBUSB_CLASS_HUB;
    result.speed_mbit = megabits(libusb_get_device_speed(device));
    result.may_open = access(result.node().c_str(), R_OK | W_OK) == 0;
    std::string control;
    std::ifstream(power_control(result)) >> control;
    result.autosuspend = control == "auto";
    return result;
}

}  // namespace

std::string UsbDevice::name() const {
    return ports.empty() ? fmt::format("usb{}", bus) : fmt::format("{}-{}", bus, fmt::join(ports, "."));
}

std::string UsbDevice::node() const { return fmt::format("/dev/bus/usb/{:03}/{:03}", bus, address); }

std::vector<UsbDevice> list_usb_devices() {
    const DeviceList list;
    std::vector<UsbDevice> result;
    for (libusb_device* device : list.devices()) result.push_back(describe(device));
    return result;
}

bool keep_awake(const UsbDevice& device) {
    std::ofstream file(power_control(device));
    file << "on" << std::flush;
    return file.good();
}

void reset_usb_device(const UsbDevice& device) {
    const DeviceList list;
    for (libusb_device* candidate : list.devices()) {
        if (describe(candidate).node() != device.node()) continue;
        libusb_device_handle* handle = nullptr;
        if (const int code = libusb_open(candidate, &handle); code < 0)
            throw usb_error("cannot open USB device " + device.name(), code);
        const std::unique_ptr<libusb_device_handle, decltype(&libusb_close)> open(handle, libusb_close);
        const int code = libusb_reset_device(handle);
        // Found anew under another address: that is a reset too.
        if (code < 0 && code != LIBUSB_ERROR_NOT_FOUND)
            throw usb_error("cannot reset USB device " + device.name(), code);
        return;
    }
    throw Error(ExitStatus::unavailable, fmt::format("USB device {} is no longer there", device.name()));
}

}  // namespace touchstone
