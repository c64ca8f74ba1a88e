#include "platform/usb/depth_cameras.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <optional>
#include <string_view>

namespace touchstone {
namespace {

enum class Part { camera, kinect_camera, kinect_motor, kinect_sound };

struct Id {
    std::uint16_t vendor;
    std::optional<std::uint16_t> product;  ///< nothing = all of the vendor
    Part part;
    std::string_view model;
};

constexpr std::uint16_t microsoft = 0x045e, prime_sense = 0x1d27, orbbec = 0x2bc5;
constexpr std::string_view xbox = "Kinect v1", windows = "Kinect v1 for Windows";

constexpr std::array ids{
    Id{microsoft, 0x02ae, Part::kinect_camera, xbox},
    Id{microsoft, 0x02b0, Part::kinect_motor, xbox},
    Id{microsoft, 0x02ad, Part::kinect_sound, xbox},
    Id{microsoft, 0x02bf, Part::kinect_camera, windows},
    Id{microsoft, 0x02c2, Part::kinect_motor, windows},
    Id{microsoft, 0x02bb, Part::kinect_sound, windows},
    Id{microsoft, 0x02be, Part::kinect_sound, windows},
    Id{microsoft, 0x02c3, Part::kinect_sound, windows},
    Id{prime_sense, std::nullopt, Part::camera, "PrimeSense or Xtion"},
    Id{orbbec, std::nullopt, Part::camera, "Orbbec"},
};

const Id* id_of(const UsbDevice& device) {
    const auto found = std::find_if(ids.begin(), ids.end(), [&](const Id& id) {
        return id.vendor == device.vendor && (!id.product || *id.product == device.product);
    });
    return found == ids.end() || device.is_hub ? nullptr : &*found;
}

bool is_part(const UsbDevice& device, Part part) {
    const Id* id = id_of(device);
    return id != nullptr && id->part == part;
}

bool below(const UsbDevice& device, const std::vector<int>& hub) {
    return device.ports.size() > hub.size() && std::equal(hub.begin(), hub.end(), device.ports.begin());
}

std::vector<int> hub_of(std::vector<int> ports) {
    if (!ports.empty()) ports.pop_back();
    return ports;
}

/// Where the whole camera is plugged in: the parts of a Kinect hang on a hub inside it.
std::vector<int> plug_of(const UsbDevice& device, Part part) {
    return part == Part::camera ? device.ports : hub_of(device.ports);
}

bool has_camera_beside(const UsbDevice& motor, std::span<const UsbDevice> devices) {
    const auto inner_hub = hub_of(motor.ports);
    return std::any_of(devices.begin(), devices.end(), [&](const UsbDevice& other) {
        return other.bus == motor.bus && is_part(other, Part::kinect_camera) &&
               hub_of(other.ports) == inner_hub;
    });
}

std::vector<UsbDevice> sharing_with(const UsbDevice& device, Part part, std::span<const UsbDevice> devices) {
    const auto plug = plug_of(device, part);
    const auto hub = hub_of(plug);
    std::vector<UsbDevice> others;
    if (hub.empty()) return others;
    for (const UsbDevice& other : devices) {
        if (other.bus != device.bus || other.is_hub || other.ports == plug) continue;
        if (below(other, hub) && !below(other, plug)) others.push_back(other);
    }
    return others;
}

}  // namespace

std::vector<UsbDepthCamera> find_depth_cameras(std::span<const UsbDevice> devices) {
    std::vector<UsbDepthCamera> cameras;
    for (const UsbDevice& device : devices) {
        const Id* id = id_of(device);
        if (id == nullptr || id->part == Part::kinect_sound) continue;
        const bool motor = id->part == Part::kinect_motor;
        if (motor && has_camera_beside(device, devices)) continue;
        UsbDepthCamera camera{std::string(id->model), UsbCameraState::ready, device,
                              sharing_with(device, id->part, devices)};
        if (!device.may_open) camera.state = UsbCameraState::no_permission;
        if (motor) camera.state = UsbCameraState::no_power;
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

std::string udev_rules_commands() {
    return fmt::format(
        "sudo cp {} /etc/udev/rules.d/ && sudo udevadm control --reload && sudo udevadm trigger",
        TOUCHSTONE_UDEV_RULES);
}

std::string problem_of(const UsbDepthCamera& camera) {
    const std::string where = fmt::format("{} at USB {}", camera.model, camera.device.name());
    switch (camera.state) {
        case UsbCameraState::no_power:
            return where + " has no power, only its motor answers: plug in its power supply";
        case UsbCameraState::no_permission:
            return fmt::format("{} may not be opened by this user: {}, then plug it in again", where,
                               udev_rules_commands());
        case UsbCameraState::ready:
            break;
    }
    return {};
}

}  // namespace touchstone
