#pragma once

#include <chrono>

namespace touchstone {

/// OpenNI2 with its drivers, loaded while at least one of these lives. Every DepthCamera holds one. Unloading
/// takes a quarter of a second and more: a program that opens cameras again and again keeps one of its own.
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

/// Waits until a depth camera is there; false when the time is over. Returns within 250 ms of its coming
/// where the driver announces it, else within 2 s.
bool wait_for_device(std::chrono::milliseconds timeout);

}  // namespace touchstone
