#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace touchstone {

/// One device on USB, as it is known without opening it.
struct UsbDevice {
    std::uint16_t vendor = 0, product = 0;
    int bus = 0, address = 0;
    std::vector<int> ports;  ///< from the root hub to the device; empty for a root hub
    bool is_hub = false;
    int speed_mbit = 0;        ///< 0 = unknown
    bool may_open = false;     ///< this user may read and write its node
    bool autosuspend = false;  ///< the kernel may put it to sleep

    /// "1-2.3", as the kernel names it.
    std::string name() const;
    /// "/dev/bus/usb/001/005"
    std::string node() const;
};

/// All that is plugged in now. Throws Error{unavailable} where USB cannot be read.
std::vector<UsbDevice> list_usb_devices();

/// Has the kernel keep a device awake. False where this user may not: the udev rules do it then.
bool keep_awake(const UsbDevice& device);

/// Resets a device that no longer answers, as if it were plugged in anew. Throws Error{unavailable}.
void reset_usb_device(const UsbDevice& device);

}  // namespace touchstone
