#include "platform/camera/sensor_session.hpp"

#include <OpenNI.h>
#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <set>
#include <string_view>
#include <thread>

#include "platform/camera/attached_devices.hpp"
#include "platform/camera/openni_error.hpp"
#include "platform/camera/sensor_uri.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto poll_period = std::chrono::milliseconds(250);

bool is_camera(const openni::DeviceInfo& device) {
    // The stock drivers folder holds a dummy driver; some builds of it announce a device.
    if (std::string_view(device.getName()).find("Dummy") != std::string_view::npos) return false;
    const std::string_view uri = device.getUri();
    return !uri.starts_with('/') && !uri.ends_with(".oni") &&
           classify_sensor(device.getUri()) == SensorKind::device;
}

}  // namespace

SensorSession::SensorSession() {
    if (openni::OpenNI::initialize() != openni::STATUS_OK) {
        const std::string reason = one_line(openni::OpenNI::getExtendedError());
        openni::OpenNI::shutdown();
        throw Error(ExitStatus::unavailable, fmt::format("OpenNI2 does not start: {}", reason));
    }
    openni::OpenNI::setLogConsoleOutput(false);
}

SensorSession::~SensorSession() { openni::OpenNI::shutdown(); }

std::optional<std::string> first_attached_device() {
    openni::Array<openni::DeviceInfo> devices;
    openni::OpenNI::enumerateDevices(&devices);
    for (int i = 0; i < devices.getSize(); ++i) {
        if (is_camera(devices[i])) return devices[i].getUri();
    }
    return std::nullopt;
}

bool any_device_attached() {
    const SensorSession session;
    return first_attached_device().has_value();
}

std::vector<std::string> loaded_drivers() {
    constexpr std::string_view folder = "/OpenNI2/Drivers/";
    std::set<std::string> names;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        const std::size_t at = line.find(folder);
        if (at == std::string::npos) continue;
        const std::string file = line.substr(at + folder.size());
        const std::size_t start = file.starts_with("lib") ? 3 : 0;
        names.insert(file.substr(start, file.find('.') - start));
    }
    return {names.begin(), names.end()};
}

bool wait_for_device(std::chrono::milliseconds timeout) {
    const SensorSession session;
    const auto deadline = Clock::now() + timeout;
    while (!first_attached_device()) {
        if (Clock::now() >= deadline) return false;
        std::this_thread::sleep_until(std::min(deadline, Clock::now() + poll_period));
    }
    return true;
}

}  // namespace touchstone
