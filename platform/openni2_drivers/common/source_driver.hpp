#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "platform/openni2_drivers/common/driver_api.hpp"
#include "platform/openni2_drivers/common/frame_source.hpp"

namespace touchstone {

/// What tells one driver of ours from another.
struct SourceScheme {
    std::string prefix;  ///< of the URIs it takes, with the colon: "seq:"
    std::string name;    ///< of its devices
    /// Opens the source that the rest of the URI names; throws Error.
    std::function<std::unique_ptr<FrameSource>(std::string_view)> open;
};

/// An OpenNI2 driver over a FrameSource. A module derives from it with a constructor that takes
/// OniDriverServices*, and exports that class with ONI_EXPORT_DRIVER.
class SourceDriver : public oni::driver::DriverBase {
  public:
    SourceDriver(OniDriverServices* services, SourceScheme scheme);

    OniStatus tryDevice(const char* uri) override;
    oni::driver::DeviceBase* deviceOpen(const char* uri, const char* mode) override;
    void deviceClose(oni::driver::DeviceBase* device) override;
    void shutdown() override;

  private:
    OniDeviceInfo device_info(const char* uri) const;
    void unplug(const OniDeviceInfo& info, double back_after_s);

    SourceScheme scheme_;
    std::mutex mutex_;
    std::jthread return_;  ///< announces what was pulled out last
};

}  // namespace touchstone
