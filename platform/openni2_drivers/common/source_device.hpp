#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "platform/openni2_drivers/common/driver_api.hpp"
#include "platform/openni2_drivers/common/driver_properties.h"
#include "platform/openni2_drivers/common/frame_source.hpp"
#include "platform/openni2_drivers/common/source_stream.hpp"

namespace touchstone {

/// One FrameSource as an OpenNI2 device: a depth stream, and a colour stream where the source has colour.
///
/// Pace step: tryManualTrigger(), which OpenNI calls in the thread of a reader that waits and finds no frame,
/// makes the next frame; a program with one reading thread therefore loses none. Pace live: an own thread
/// makes frames at the source's rate while a stream runs; one that is late waits for the next tick of the
/// clock, so nothing queues up. Colour goes out before depth, both with the frame's index and time; a frame
/// without colour has dataSize 0. After the last frame the device is in ONI_DEVICE_STATE_EOF; bad data in
/// mid-stream makes it ONI_DEVICE_STATE_ERROR with the reason in TOUCHSTONE_DEVICE_PROPERTY_LAST_ERROR.
class SourceDevice : public oni::driver::DeviceBase {
  public:
    /// `unplugged` is told after how many seconds the device is back.
    SourceDevice(std::unique_ptr<FrameSource> source, std::function<void(OniDeviceState)> state_changed,
                 std::function<void(double)> unplugged = {});
    ~SourceDevice() override;

    OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
    oni::driver::StreamBase* createStream(OniSensorType sensor) override;
    void destroyStream(oni::driver::StreamBase* stream) override;
    OniStatus getProperty(int id, void* data, int* size) override;
    OniStatus setProperty(int id, const void* data, int size) override;
    OniBool isPropertySupported(int id) override;
    OniStatus tryManualTrigger() override;

  private:
    enum class Outcome { delivered, end, failed, unplugged };

    void running_changed();
    void run_live();
    /// False once the source has ended or failed.
    bool deliver_next();
    Outcome make_frame();
    bool any_stream_runs() const;

    std::unique_ptr<FrameSource> source_;
    const SourceInfo info_;
    std::function<void(OniDeviceState)> state_changed_;
    std::function<void(double)> unplugged_;
    StreamDescription depth_description_, color_description_;
    OniSensorInfo sensors_[2]{};

    std::mutex mutex_;  ///< the source, its frame and the streams
    SourceFrame frame_;
    std::unique_ptr<SourceStream> depth_, color_;
    TouchstoneDriverError error_{};
    bool ended_ = false, has_run_ = false;

    std::atomic<Pace> pace_;
    std::thread live_thread_;
    std::atomic<bool> live_ = false;
};

}  // namespace touchstone
