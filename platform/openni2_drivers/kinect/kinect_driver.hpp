#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "platform/openni2_drivers/common/driver_api.hpp"
#include "platform/openni2_drivers/kinect/freenect_thread.hpp"
#include "platform/openni2_drivers/kinect/kinect_device.hpp"

namespace touchstone {

/// Kinects v1 as OpenNI2 devices "kinect:0", "kinect:1", ... in the order of libfreenect. Looks twice a
/// second which are plugged in, announces them and withdraws them. libfreenect does not say which Kinect was
/// lost: of several that stream all are withdrawn, and those still there announced again.
class KinectDriver : public oni::driver::DriverBase {
  public:
    explicit KinectDriver(OniDriverServices* services) : DriverBase(services) {}

    OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                         oni::driver::DeviceDisconnectedCallback disconnected,
                         oni::driver::DeviceStateChangedCallback state_changed, void* cookie) override;
    OniStatus tryDevice(const char*) override { return ONI_STATUS_NO_DEVICE; }
    oni::driver::DeviceBase* deviceOpen(const char* uri, const char* mode) override;
    void deviceClose(oni::driver::DeviceBase* device) override;
    void shutdown() override;

  private:
    void watch();
    void look();
    void withdraw_lost();
    void lose_streaming();

    std::unique_ptr<FreenectThread> freenect_;
    std::mutex mutex_;  ///< what follows; never held while OpenNI is called
    std::condition_variable changed_;
    std::set<int> announced_;
    std::vector<KinectDevice*> open_;
    std::set<int> lost_;
    bool ending_ = false;
    std::thread watch_;
};

}  // namespace touchstone
