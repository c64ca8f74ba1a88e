#pragma once

#include <span>
#include <string>
#include <vector>

#include "platform/usb/usb_device.hpp"

namespace touchstone {

enum class UsbCameraState {
    ready,
    no_power,       ///< a Kinect whose motor answers while its camera does not: no power supply
    no_permission,  ///< this user may not open it
};

/// One depth camera on USB.
struct UsbDepthCamera {
    std::string model;
    UsbCameraState state = UsbCameraState::ready;
    UsbDevice device;                ///< the camera; of a Kinect without power the part that answers
    std::vector<UsbDevice> sharing;  ///< others on the hub it is plugged into; none at the computer itself
};

/// The depth cameras among the devices of a machine.
std::vector<UsbDepthCamera> find_depth_cameras(std::span<const UsbDevice> devices);

/// What is wrong and what to do about it, one sentence; empty where the camera is ready.
std::string problem_of(const UsbDepthCamera& camera);

/// The shell commands that let every user open depth cameras and keep them awake.
std::string udev_rules_commands();

}  // namespace touchstone
