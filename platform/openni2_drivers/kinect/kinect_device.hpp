#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "platform/openni2_drivers/common/driver_api.hpp"
#include "platform/openni2_drivers/common/driver_properties.h"
#include "platform/openni2_drivers/common/source_stream.hpp"
#include "platform/openni2_drivers/kinect/device_clock.hpp"
#include "platform/openni2_drivers/kinect/freenect_thread.hpp"
#include "platform/openni2_drivers/kinect/registration.hpp"
#include "platform/openni2_drivers/kinect/zero_plane.hpp"

namespace touchstone {

/// One Kinect v1 as an OpenNI2 device: depth in mm and colour, 640x480 at 30 Hz each. A camera of the Kinect
/// sends only while its stream runs. All members are used in libfreenect's thread; calls from others wait for
/// it, at most one frame.
class KinectDevice : public oni::driver::DeviceBase {
  public:
    /// Throws Error{unavailable} where the Kinect cannot be opened. `thread` must outlive the device.
    KinectDevice(FreenectThread& thread, int index);
    ~KinectDevice() override;

    int index() const { return index_; }
    /// It is gone: nothing comes from now on. In libfreenect's thread. False where nothing was running.
    bool lose();

    OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
    oni::driver::StreamBase* createStream(OniSensorType sensor) override;
    void destroyStream(oni::driver::StreamBase* stream) override;
    OniStatus getProperty(int id, void* data, int* size) override;
    OniStatus setProperty(int id, const void* data, int size) override;
    OniBool isPropertySupported(int id) override;
    OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  private:
    void open(freenect_context* context);
    void read_calibration();
    bool apply_running();
    bool start_depth();
    bool start_color();
    void take_depth(const void* raw, std::uint32_t ticks);
    void take_color(const std::uint8_t* rgb, std::uint32_t ticks);
    std::uint64_t time_us(std::uint32_t ticks);
    OniStatus get(int id, void* data, int* size);
    OniStatus set(int id, const void* data, int size);
    OniStatus set_registered(const void* data, int size);
    OniStatus set_light(const void* data, int size);
    OniStatus set_tilt(const void* data, int size);
    OniStatus get_motion(int id, void* data, int* size);
    bool switch_automatic(CameraAutomatic what, bool on);
    Intrinsics intrinsics() const;

    FreenectThread& thread_;
    const int index_;
    freenect_device* device_ = nullptr;
    bool has_motor_ = false;
    ZeroPlane plane_;
    DepthTable table_{};
    RegistrationTables tables_;
    bool registered_ = false;
    int light_ = TOUCHSTONE_LIGHT_OFF;
    StreamDescription depth_description_, color_description_;
    OniSensorInfo sensors_[2]{};
    std::unique_ptr<SourceStream> depth_, color_;
    bool depth_on_ = false, color_on_ = false;
    int depth_frames_ = 0, color_frames_ = 0;
    DeviceClock clock_;
    std::vector<std::uint16_t> depth_mm_, registered_mm_;
};

}  // namespace touchstone
