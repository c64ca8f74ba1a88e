#include "platform/openni2_drivers/common/source_driver.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <utility>

#include "platform/openni2_drivers/common/source_device.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

SourceDriver::SourceDriver(OniDriverServices* services, SourceScheme scheme)
    : DriverBase(services), scheme_(std::move(scheme)) {}

OniStatus SourceDriver::tryDevice(const char* uri) {
    const std::string_view text = uri;
    if (!text.starts_with(scheme_.prefix) || text.size() >= ONI_MAX_STR) return ONI_STATUS_NO_DEVICE;
    const OniDeviceInfo info = device_info(uri);
    deviceConnected(&info);
    return ONI_STATUS_OK;
}

// OpenNI2 does not try a driver again with a URI that it has withdrawn: the device must be announced anew.
void SourceDriver::unplug(const OniDeviceInfo& info, double back_after_s) {
    deviceDisconnected(&info);
    const std::lock_guard lock(mutex_);
    return_ = std::jthread([this, info, back_after_s](const std::stop_token& ending) {
        std::mutex unshared;
        std::unique_lock waiting(unshared);
        std::condition_variable_any().wait_for(waiting, ending, std::chrono::duration<double>(back_after_s),
                                               [] { return false; });
        if (!ending.stop_requested()) deviceConnected(&info);
    });
}

void SourceDriver::shutdown() {
    const std::lock_guard lock(mutex_);
    return_ = std::jthread();
}

oni::driver::DeviceBase* SourceDriver::deviceOpen(const char* uri, const char*) {
    ExitStatus status = ExitStatus::bad_data;
    std::string message;
    try {
        auto source = scheme_.open(std::string_view(uri).substr(scheme_.prefix.size()));
        auto state_changed = [this, info = device_info(uri)](OniDeviceState state) {
            deviceStateChanged(&info, state);
        };
        auto unplugged = [this, info = device_info(uri)](double back_after_s) { unplug(info, back_after_s); };
        return std::make_unique<SourceDevice>(std::move(source), std::move(state_changed),
                                              std::move(unplugged))
            .release();
    } catch (const Error& error) {
        status = error.status();
        message = error.what();
    } catch (const std::exception& error) {
        message = error.what();
    }
    getServices().errorLoggerAppend("%s%d %s%s", TOUCHSTONE_ERROR_PREFIX, static_cast<int>(status),
                                    message.c_str(), TOUCHSTONE_ERROR_SUFFIX);
    return nullptr;
}

void SourceDriver::deviceClose(oni::driver::DeviceBase* device) { delete device; }

OniDeviceInfo SourceDriver::device_info(const char* uri) const {
    OniDeviceInfo info{};
    std::snprintf(info.uri, sizeof info.uri, "%s", uri);
    std::snprintf(info.vendor, sizeof info.vendor, "Touchstone");
    std::snprintf(info.name, sizeof info.name, "%s", scheme_.name.c_str());
    return info;
}

}  // namespace touchstone
