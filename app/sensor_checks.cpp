#include "app/sensor_checks.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "platform/camera/attached_devices.hpp"
#include "platform/camera/sensor_session.hpp"

namespace touchstone {
namespace {

CheckLine power_line(const UsbDepthCamera& camera) {
    if (camera.state == UsbCameraState::no_power) {
        return {"power", CheckStatus::fail, camera.model + ": only its motor answers, it has no power supply",
                "plug in its power supply: USB alone does not feed it"};
    }
    return {"power", CheckStatus::ok, camera.model + " is powered", {}};
}

CheckLine permission_line(const UsbDepthCamera& camera) {
    const std::string node = camera.device.node();
    if (camera.state != UsbCameraState::no_permission)
        return {"permission", CheckStatus::ok, "this user may open " + node, {}};
    return {"permission", CheckStatus::fail, "this user may not open " + node,
            udev_rules_commands() + ", then plug the camera in again"};
}

CheckLine sleep_line(const UsbDepthCamera& camera) {
    if (!camera.device.autosuspend) return {"USB sleep", CheckStatus::ok, "the kernel keeps it awake", {}};
    return {"USB sleep", CheckStatus::warn,
            "the kernel may put it to sleep; some then need to be plugged in anew",
            "install the udev rules: " + udev_rules_commands()};
}

CheckLine hub_line(const UsbDepthCamera& camera) {
    if (camera.sharing.empty())
        return {"bandwidth", CheckStatus::ok, "it shares its USB socket with nothing", {}};
    std::vector<std::string> others;
    for (const UsbDevice& device : camera.sharing)
        others.push_back(fmt::format("{:04x}:{:04x} at {}", device.vendor, device.product, device.name()));
    return {"bandwidth", CheckStatus::warn, fmt::format("it shares a hub with {}", fmt::join(others, ", ")),
            "plug the camera into the computer itself: it needs most of a USB 2 bus"};
}

void add_camera(const UsbDepthCamera& camera, std::vector<CheckLine>& lines) {
    lines.push_back(
        {"sensor", CheckStatus::ok, fmt::format("{} at USB {}", camera.model, camera.device.name()), {}});
    lines.push_back(power_line(camera));
    if (camera.state == UsbCameraState::no_power) return;
    lines.push_back(permission_line(camera));
    lines.push_back(sleep_line(camera));
    lines.push_back(hub_line(camera));
}

OpenniState ask_openni() {
    const SensorSession session;
    return {loaded_drivers(), first_attached_device().value_or("")};
}

}  // namespace

std::vector<CheckLine> usb_lines(std::span<const UsbDepthCamera> cameras) {
    std::vector<CheckLine> lines;
    for (const UsbDepthCamera& camera : cameras) add_camera(camera, lines);
    if (lines.empty()) {
        lines.push_back(
            {"sensor", CheckStatus::fail, "no depth camera is plugged in",
             "plug one in; without one, name a recording or a simulation: touchstone --sensor sim:mixed, or "
             "[sensor] uri in the configuration"});
    }
    return lines;
}

CheckLine driver_line(const OpenniState& openni, std::span<const UsbDepthCamera> cameras) {
    const std::string drivers = fmt::format("{}", fmt::join(openni.drivers, ", "));
    const bool ready = std::any_of(cameras.begin(), cameras.end(), [](const UsbDepthCamera& camera) {
        return camera.state == UsbCameraState::ready;
    });
    if (openni.drivers.empty())
        return {"drivers", CheckStatus::fail, "OpenNI2 has no drivers", "install libopenni2-0"};
    if (!openni.announced.empty())
        return {"drivers", CheckStatus::ok, fmt::format("{} ({})", openni.announced, drivers), {}};
    if (!ready) return {"drivers", CheckStatus::ok, drivers, {}};
    return {"drivers", CheckStatus::fail, "no OpenNI2 driver has taken the camera; there is " + drivers,
            "pull it out and plug it in again; if that does not help, put the maker's OpenNI2 driver beside "
            "them"};
}

std::vector<CheckLine> check_sensors() {
    std::vector<UsbDepthCamera> cameras;
    std::vector<CheckLine> lines;
    try {
        cameras = find_depth_cameras(list_usb_devices());
        lines = usb_lines(cameras);
    } catch (const Error& error) {
        lines.push_back({"sensor", CheckStatus::fail, error.what(),
                         "this machine has no USB, or a container hides it: it needs /dev/bus/usb and /sys"});
    }
    try {
        lines.push_back(driver_line(ask_openni(), cameras));
    } catch (const Error& error) {
        lines.push_back({"drivers", CheckStatus::fail, error.what(), "install libopenni2-0"});
    }
    return lines;
}

}  // namespace touchstone
