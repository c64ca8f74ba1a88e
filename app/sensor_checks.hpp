#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/check_report.hpp"
#include "platform/usb/depth_cameras.hpp"

namespace touchstone {

/// What OpenNI2 has: its drivers, and the camera that one of them has announced.
struct OpenniState {
    std::vector<std::string> drivers;
    std::string announced;  ///< URI; empty = none
};

/// Cameras, their power, permissions, sleep and hubs.
std::vector<CheckLine> usb_lines(std::span<const UsbDepthCamera> cameras);

/// Whether a driver has taken the camera that is ready on USB.
CheckLine driver_line(const OpenniState& openni, std::span<const UsbDepthCamera> cameras);

/// Both, of this machine now.
std::vector<CheckLine> check_sensors();

}  // namespace touchstone
