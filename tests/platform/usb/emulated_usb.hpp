#pragma once

#include <array>
#include <cstdint>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <string>
#include <umockdev.h>

namespace touchstone {

/// A machine with USB devices of our choice, for this process and those it starts. Needs umockdev's library
/// to be preloaded, which ctest sees to.
class EmulatedUsb {
  public:
    EmulatedUsb() : testbed_(umockdev_testbed_new()) {
        for (const int bus : {1, 2}) add(fmt::format("usb{}", bus), bus, 1, 0x1d6b, 0x0002, 9);
    }
    ~EmulatedUsb() { g_object_unref(testbed_); }
    EmulatedUsb(const EmulatedUsb&) = delete;
    EmulatedUsb& operator=(const EmulatedUsb&) = delete;

    static bool works() { return umockdev_in_mock_environment() != 0; }

    /// "1-2.3" on bus 1; class 9 is a hub.
    void plug_in(const std::string& name, std::uint16_t vendor, std::uint16_t product, int usb_class = 0) {
        add(name, name[0] - '0', ++last_address_, vendor, product, usb_class);
    }
    void pull_out(const std::string& name) {
        umockdev_testbed_remove_device(testbed_, sys_path(name).c_str());
        nodes_.erase(name);
    }
    /// In the emulated /dev.
    std::string real_node(const std::string& name) const { return root() + nodes_.at(name); }
    std::string root() const {
        const std::unique_ptr<char, decltype(&g_free)> folder(umockdev_testbed_get_root_dir(testbed_),
                                                              g_free);
        return folder.get();
    }
    std::string attribute(const std::string& name, const std::string& attribute) const {
        std::string path = root() + sys_path(name) + "/" + attribute;
        return path;
    }

    void plug_in_kinect(const std::string& hub) {
        plug_in(hub, 0x0409, 0x005a, 9);
        plug_in(hub + ".1", 0x045e, 0x02b0);
        plug_in(hub + ".2", 0x045e, 0x02ad);
        plug_in(hub + ".3", 0x045e, 0x02ae);
    }
    void plug_in_kinect_without_power(const std::string& hub) {
        plug_in(hub, 0x0409, 0x005a, 9);
        plug_in(hub + ".1", 0x045e, 0x02b0);
    }

  private:
    static std::string sys_path(const std::string& name) { return "/sys/devices/" + name; }

    void add(const std::string& name, int bus, int address, std::uint16_t vendor, std::uint16_t product,
             int usb_class) {
        const std::string node = fmt::format("/dev/bus/usb/{:03}/{:03}", bus, address);
        const auto low = [](int value) { return value & 0xff; };
        const auto high = [](int value) { return value >> 8; };
        const std::string descriptors = fmt::format(
            "12010002{:02X}000040{:02X}{:02X}{:02X}{:02X}000100000001"
            "09020900000100C032",
            usb_class, low(vendor), high(vendor), low(product), high(product));
        const std::string text = fmt::format(
            "P: /devices/{0}\nN: bus/usb/{1:03}/{2:03}\nE: DEVNAME={3}\nE: DEVTYPE=usb_device\n"
            "E: SUBSYSTEM=usb\nE: BUSNUM={1:03}\nE: DEVNUM={2:03}\nA: busnum={1}\\n\nA: devnum={2}\\n\n"
            "A: speed=480\\n\nA: bConfigurationValue=1\\n\nA: idVendor={4:04x}\\n\nA: idProduct={5:04x}\\n\n"
            "A: power/control=auto\\n\nH: descriptors={6}\n\n",
            name, bus, address, node, vendor, product, descriptors);
        GError* error = nullptr;
        if (!umockdev_testbed_add_from_string(testbed_, text.c_str(), &error)) {
            ADD_FAILURE() << error->message;
            g_error_free(error);
        }
        nodes_[name] = node;
    }

    UMockdevTestbed* testbed_;
    std::map<std::string, std::string> nodes_;
    int last_address_ = 1;
};

}  // namespace touchstone
