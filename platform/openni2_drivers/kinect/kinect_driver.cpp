#include "platform/openni2_drivers/kinect/kinect_driver.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr std::string_view scheme = "kinect:";
constexpr auto look_period = std::chrono::milliseconds(500);

OniDeviceInfo device_info(int index) {
    OniDeviceInfo info{};
    std::snprintf(info.uri, sizeof info.uri, "kinect:%d", index);
    std::snprintf(info.vendor, sizeof info.vendor, "Microsoft");
    std::snprintf(info.name, sizeof info.name, "Kinect");
    info.usbVendorId = 0x045e;
    info.usbProductId = 0x02ae;
    return info;
}

std::optional<int> index_of(std::string_view uri) {
    if (!uri.starts_with(scheme)) return std::nullopt;
    uri.remove_prefix(scheme.size());
    int index = 0;
    const auto [end, code] = std::from_chars(uri.data(), uri.data() + uri.size(), index);
    if (code != std::errc{} || end != uri.data() + uri.size() || index < 0) return std::nullopt;
    return index;
}

}  // namespace

OniStatus KinectDriver::initialize(oni::driver::DeviceConnectedCallback connected,
                                   oni::driver::DeviceDisconnectedCallback disconnected,
                                   oni::driver::DeviceStateChangedCallback state_changed, void* cookie) {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    freenect_ = std::make_unique<FreenectThread>([this] { lose_streaming(); });
    look();
    watch_ = std::thread([this] { watch(); });
    return ONI_STATUS_OK;
}

void KinectDriver::shutdown() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_one();
    if (watch_.joinable()) watch_.join();
    freenect_.reset();
}

oni::driver::DeviceBase* KinectDriver::deviceOpen(const char* uri, const char*) {
    const auto index = index_of(uri);
    if (!index) return nullptr;
    try {
        auto device = std::make_unique<KinectDevice>(*freenect_, *index);
        const std::lock_guard lock(mutex_);
        open_.push_back(device.get());
        return device.release();
    } catch (const Error& error) {
        getServices().errorLoggerAppend("%s%d %s%s", TOUCHSTONE_ERROR_PREFIX,
                                        static_cast<int>(error.status()), error.what(),
                                        TOUCHSTONE_ERROR_SUFFIX);
        return nullptr;
    }
}

void KinectDriver::deviceClose(oni::driver::DeviceBase* device) {
    {
        const std::lock_guard lock(mutex_);
        std::erase(open_, device);
    }
    delete device;
}

void KinectDriver::watch() {
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, look_period, [this] { return ending_ || !lost_.empty(); });
            if (ending_) return;
        }
        withdraw_lost();
        look();
    }
}

void KinectDriver::look() {
    const int count = freenect_->run(
        [](freenect_context* context) { return context == nullptr ? 0 : freenect_num_devices(context); });
    std::vector<int> came, went;
    {
        const std::lock_guard lock(mutex_);
        for (int index = 0; index < count; ++index) {
            if (announced_.insert(index).second) came.push_back(index);
        }
        for (const int index : announced_) {
            if (index >= count) went.push_back(index);
        }
        for (const int index : went) announced_.erase(index);
    }
    for (const int index : went) {
        const OniDeviceInfo info = device_info(index);
        deviceDisconnected(&info);
    }
    for (const int index : came) {
        const OniDeviceInfo info = device_info(index);
        deviceConnected(&info);
    }
}

void KinectDriver::withdraw_lost() {
    std::set<int> lost;
    {
        const std::lock_guard lock(mutex_);
        for (const int index : std::exchange(lost_, {})) {
            if (announced_.erase(index) > 0) lost.insert(index);
        }
    }
    for (const int index : lost) {
        const OniDeviceInfo info = device_info(index);
        deviceDisconnected(&info);
    }
}

void KinectDriver::lose_streaming() {
    const std::lock_guard lock(mutex_);
    for (KinectDevice* device : open_) {
        if (device->lose()) lost_.insert(device->index());
    }
    changed_.notify_one();
}

}  // namespace touchstone
