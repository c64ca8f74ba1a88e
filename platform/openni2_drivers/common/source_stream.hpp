#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "platform/openni2_drivers/common/driver_api.hpp"

namespace touchstone {

/// What a stream tells about itself.
struct StreamDescription {
    OniSensorType sensor = ONI_SENSOR_DEPTH;
    OniVideoMode mode{};
    float horizontal_fov_rad = 0;
    float vertical_fov_rad = 0;
    bool can_mirror = false;
    /// Of depth. The recorder's depth codec turns values that are not below it into others; 65535 itself
    /// never occurs: it means invalid in several data sets.
    int max_depth_mm = 65535;
};

/// What a colour camera does by itself unless it is told not to.
enum class CameraAutomatic { exposure, white_balance };

/// The whole angle that `size_px` pixels cover, radians.
float field_of_view_rad(int size_px, float focal_px);

/// Depth in millimetres or RGB, one video mode, never cropped.
class SourceStream : public oni::driver::StreamBase {
  public:
    /// `running_changed` is called after each change; where it says false the stream does not start.
    SourceStream(const StreamDescription& description, std::function<bool()> running_changed);

    OniStatus start() override;
    void stop() override;
    bool running() const { return running_; }
    /// Makes them properties of the stream, on at first. `switch_camera` says whether the camera obeyed.
    void offer_automatics(std::function<bool(CameraAutomatic, bool on)> switch_camera);
    /// For a driver whose camera geometry changes; listeners are told.
    void set_field_of_view(float horizontal_rad, float vertical_rad);

    OniStatus setProperty(int id, const void* data, int size) override;
    OniStatus getProperty(int id, void* data, int* size) override;
    OniBool isPropertySupported(int id) override;
    void notifyAllProperties() override;

    /// Hands one picture to OpenNI. Without pixels the frame has dataSize 0: no picture belongs to this
    /// index.
    void deliver(const void* pixels, std::size_t bytes, int index, std::uint64_t timestamp_us);

  private:
    void copy_rows(const void* pixels, std::size_t bytes, void* target) const;
    OniStatus switch_automatic(CameraAutomatic what, const void* data, int size);
    std::atomic<bool>& is_on(CameraAutomatic what) {
        return what == CameraAutomatic::exposure ? auto_exposure_ : auto_white_balance_;
    }

    StreamDescription description_;
    std::function<bool()> running_changed_;
    std::atomic<bool> running_ = false;
    std::atomic<bool> mirrored_ = false;
    std::function<bool(CameraAutomatic, bool)> switch_camera_;  ///< empty: they are not offered
    std::atomic<bool> auto_exposure_ = true, auto_white_balance_ = true;
};

}  // namespace touchstone
