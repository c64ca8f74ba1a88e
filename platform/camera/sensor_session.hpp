#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace touchstone {

/// OpenNI2 with its drivers, loaded while at least one of these lives. Every DepthCamera holds one. Unloading
/// takes a quarter of a second, and OpenNI2 2.2 loses some 140 KB each time it is loaded and unloaded: a
/// program that opens cameras or asks for devices again and again keeps one of its own for its whole life.
class SensorSession {
  public:
    /// Throws Error{unavailable} where OpenNI2 finds no drivers.
    SensorSession();
    ~SensorSession();
    SensorSession(const SensorSession&) = delete;
    SensorSession& operator=(const SensorSession&) = delete;
};

/// Whether a driver has announced a depth camera (files and simulations do not count).
bool any_device_attached();

/// Names of the drivers that OpenNI2 has loaded, such as "PS1080", for libPS1080.so.0; a SensorSession must
/// live.
std::vector<std::string> loaded_drivers();

/// Waits until a driver announces a depth camera, which it does by itself when one is plugged in; false when
/// the time is over. Looks four times a second.
bool wait_for_device(std::chrono::milliseconds timeout);

}  // namespace touchstone
