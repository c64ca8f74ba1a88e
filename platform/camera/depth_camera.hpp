#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "platform/camera/depth_frame.hpp"
#include "platform/camera/sensor_models.hpp"
#include "platform/openni2_drivers/common/frame_source.hpp"

namespace touchstone {

enum class CameraLight { green, blinking_green, red };

/// What of a camera is not left to Touchstone and the camera's driver.
struct CameraSetup {
    std::optional<DepthMode> mode;  ///< a device must have it; recordings and simulations are as they are
    std::string models_file;        ///< of sensor models, before the built-in ones; empty: none
};

struct ReadTimeout {};  ///< no frame in time; the camera is fine as far as known
struct StreamEnd {};    ///< after the last frame of a recording, a sequence or a finite simulation
struct CameraLost {     ///< unplugged or dead: close it and wait for a device
    std::string reason;
};
using ReadResult = std::variant<DepthFrame, ReadTimeout, StreamEnd, CameraLost>;

/// One depth camera, real or replayed, through OpenNI2. Not for use from two threads at once.
class DepthCamera {
  public:
    /// Sensor URI: empty = the first attached device; PATH.oni; seq:DIR; sim:SCENE?...; else a URI of
    /// OpenNI2's. Pace: by default live for devices and sim:, step for seq: and recordings. In step every
    /// frame comes in order, as fast as it is read, none lost; a device itself knows only live. A recording
    /// is played once. with_color is a wish: has_color() tells whether the camera has colour. Throws Error:
    /// unavailable (no device, it cannot be opened), no_input, bad_data, usage.
    static DepthCamera open(const std::string& uri = {}, std::optional<Pace> pace = std::nullopt,
                            bool with_color = false, const CameraSetup& setup = {});

    DepthCamera(DepthCamera&&) noexcept;
    DepthCamera& operator=(DepthCamera&&) noexcept;
    ~DepthCamera();

    /// The next frame: in live pace the latest one. Colour is the picture nearest in time, scaled to the
    /// depth's size. Throws Error{bad_data or no_input} where the source's data are bad in mid-stream.
    ReadResult read(int timeout_ms);

    const Intrinsics& intrinsics() const;
    /// Null where the camera is none that is known.
    const SensorModel* model() const;
    /// That USB lost so far, of cameras that tell; nothing of others.
    std::optional<std::uint64_t> lost_packets() const;
    /// Frames a second that the source promises.
    double rate_hz() const;
    Pace pace() const;
    /// Frames come with colours now.
    bool has_color() const;
    /// There is a colour picture to be watched.
    bool can_see_color() const;
    /// Begins and ends the colours of a live camera while its depth goes on; nothing changes where there are
    /// none, or where they are wanted all the time. Throws Error{unavailable}.
    void watch_color(bool watched);
    /// The colour camera's exposure and white balance stay as they are, where it lets them, while its colours
    /// are watched. Put back by release_exposure(), or with the camera. Whether it lets them.
    bool hold_exposure();
    void release_exposure();
    /// Begins the streams anew, for a camera that went silent. Throws Error{unavailable}.
    void restart();
    /// What a camera's light shows, where it has one.
    void show_light(CameraLight light);

    /// A camera on USB, not a recording, a sequence or a simulation.
    bool is_device() const;
    /// It may come back once it is lost: a device, or a simulation of one.
    bool can_return() const;
    /// For people: the URI and the device's name.
    const std::string& name() const;

    /// Writes everything that is read from now on to an .oni file, depth without loss; in live pace also the
    /// frames that are not read in time. Its first frame is the next one: a live device's streams begin anew.
    /// Throws Error{io_error, unavailable}; a live camera stands still then, until restart(). Ends, with all
    /// frames written, by stop_recording() or with the camera.
    void start_recording(const std::string& path);
    void stop_recording();

  private:
    struct Impl;
    explicit DepthCamera(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace touchstone
