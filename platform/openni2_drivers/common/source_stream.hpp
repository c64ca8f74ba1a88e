#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "platform/openni2_drivers/common/driver_api.hpp"

namespace touchstone {

/// What a stream tells about itself; fixed for its life.
struct StreamDescription {
    OniSensorType sensor = ONI_SENSOR_DEPTH;
    OniVideoMode mode{};
    float horizontal_fov_rad = 0;
    float vertical_fov_rad = 0;
};

/// Depth in millimetres or RGB, one video mode, never mirrored nor cropped.
class SourceStream : public oni::driver::StreamBase {
  public:
    SourceStream(const StreamDescription& description, std::function<void()> running_changed);

    OniStatus start() override;
    void stop() override;
    bool running() const { return running_; }

    OniStatus setProperty(int id, const void* data, int size) override;
    OniStatus getProperty(int id, void* data, int* size) override;
    OniBool isPropertySupported(int id) override;
    void notifyAllProperties() override;

    /// Hands one picture to OpenNI. Without pixels the frame has dataSize 0: no picture belongs to this
    /// index.
    void deliver(const void* pixels, std::size_t bytes, int index, std::uint64_t timestamp_us);

  private:
    StreamDescription description_;
    std::function<void()> running_changed_;
    std::atomic<bool> running_ = false;
};

}  // namespace touchstone
