#pragma once

#include <OpenNI.h>
#include <atomic>
#include <cstring>
#include <string>

namespace touchstone {

/// What OpenNI tells about one device, from whatever thread it tells it.
class CameraEvents : public openni::OpenNI::DeviceStateChangedListener,
                     public openni::OpenNI::DeviceDisconnectedListener {
  public:
    explicit CameraEvents(std::string uri) : uri_(std::move(uri)) {
        openni::OpenNI::addDeviceStateChangedListener(this);
        openni::OpenNI::addDeviceDisconnectedListener(this);
    }
    ~CameraEvents() override {
        openni::OpenNI::removeDeviceDisconnectedListener(this);
        openni::OpenNI::removeDeviceStateChangedListener(this);
    }
    CameraEvents(const CameraEvents&) = delete;
    CameraEvents& operator=(const CameraEvents&) = delete;

    bool ended() const { return ended_; }
    bool failed() const { return failed_; }
    bool disconnected() const { return disconnected_; }
    bool any() const { return ended_ || failed_ || disconnected_; }

  private:
    void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override {
        if (uri_ != info->getUri()) return;
        if (state == openni::DEVICE_STATE_EOF) ended_ = true;
        if (state == openni::DEVICE_STATE_ERROR) failed_ = true;
    }
    void onDeviceDisconnected(const openni::DeviceInfo* info) override {
        if (uri_ == info->getUri()) disconnected_ = true;
    }

    const std::string uri_;
    std::atomic<bool> ended_ = false, failed_ = false, disconnected_ = false;
};

}  // namespace touchstone
