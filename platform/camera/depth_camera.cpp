#include "platform/camera/depth_camera.hpp"

#include <OpenNI.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/core.h>
#include <thread>
#include <utility>

#include "platform/camera/attached_devices.hpp"
#include "platform/camera/camera_events.hpp"
#include "platform/camera/frame_pairing.hpp"
#include "platform/camera/held_exposure.hpp"
#include "platform/camera/openni_error.hpp"
#include "platform/camera/openni_frame.hpp"
#include "platform/camera/recording.hpp"
#include "platform/camera/recording_check.hpp"
#include "platform/camera/sensor_session.hpp"
#include "platform/camera/sensor_uri.hpp"
#include "platform/openni2_drivers/common/driver_properties.h"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// OpenNI's wait does not end when a device ends or fails: wait in slices.
constexpr int slice_ms = 20;
// The stock player in lock step delivers one frame for each wait that begins without one. A second wait for
// the same frame must not begin while the player is still busy with the first, or a frame is overwritten.
constexpr int stepped_recording_slice_ms = 250;
constexpr std::chrono::milliseconds player_rest(15);

std::string resolve(const std::string& uri) {
    if (!uri.empty()) return uri;
    if (auto device = first_attached_device()) return *device;
    throw Error(ExitStatus::unavailable,
                "no depth camera is attached: plug one in, or name a recording or simulation with --sensor");
}

Pace default_pace(SensorKind kind) {
    return kind == SensorKind::recording || kind == SensorKind::sequence ? Pace::step : Pace::live;
}

}  // namespace

struct DepthCamera::Impl {
    Impl(const std::string& wanted_uri, std::optional<Pace> wanted_pace, bool with_color,
         const CameraSetup& setup);
    ~Impl();

    void open_device();
    void set_pace();
    void find_model(const std::string& models_file);
    void create_streams(bool with_color, const std::optional<DepthMode>& mode);
    void create_stream(openni::VideoStream& stream, openni::SensorType sensor, const char* what);
    void start(openni::VideoStream& stream);
    void start_streams();
    void stop_streams();
    void create_color();
    void drop_color();
    void choose_intrinsics();
    void take(int ready);
    ReadResult ending();

    // Destroyed from the last to the first: streams, device, events, session.
    SensorSession session;
    std::string user_uri;
    SensorKind kind;
    OpenniUri uri;
    CameraEvents events;
    Pace pace;
    openni::Device device;
    openni::VideoStream depth, color;
    std::optional<HeldExposure> exposure;
    std::optional<Recording> recording;
    bool has_color = false, keeps_color = false;
    std::optional<SensorModel> model;
    Intrinsics intrinsics{};
    FramePairing pairing;
    std::string name;
};

DepthCamera::Impl::Impl(const std::string& wanted_uri, std::optional<Pace> wanted_pace, bool with_color,
                        const CameraSetup& setup)
    : user_uri(resolve(wanted_uri)),
      kind(classify_sensor(user_uri)),
      uri(user_uri, kind),
      events(uri.text()),
      pace(wanted_pace.value_or(default_pace(kind))),
      pairing(kind == SensorKind::recording && with_color) {
    if (kind == SensorKind::recording) check_recording(user_uri);
    open_device();
    set_pace();
    if (kind == SensorKind::device) find_model(setup.models_file);
    create_streams(with_color, setup.mode);
    choose_intrinsics();
    start_streams();
}

DepthCamera::Impl::~Impl() {
    recording.reset();
    exposure.reset();
    stop_streams();
    // After the end the stock player's thread walks its list of streams without pause and without a lock;
    // once they are stopped it does so every 10 ms. Let it come to rest before the list changes under it.
    if (kind == SensorKind::recording) std::this_thread::sleep_for(player_rest);
    color.destroy();
    depth.destroy();
    device.close();
}

void DepthCamera::Impl::open_device() {
    if (device.open(uri.text().c_str()) == openni::STATUS_OK) {
        name = fmt::format("{} ({})", device.getDeviceInfo().getName(), user_uri);
        return;
    }
    const std::string reason = openni::OpenNI::getExtendedError();
    if (const auto error = driver_error_in(reason))
        throw Error(error->status(), uri.in_user_terms(error->what()));
    const std::string what = fmt::format("cannot open sensor {}: {}", user_uri, one_line(reason));
    if (kind == SensorKind::recording) throw Error(ExitStatus::bad_data, what);
    throw Error(ExitStatus::unavailable,
                what + "; beside URIs of attached cameras there are FILE.oni, seq:DIR and sim:SCENE");
}

void DepthCamera::Impl::set_pace() {
    if (kind == SensorKind::recording) {
        openni::PlaybackControl* playback = device.getPlaybackControl();
        if (playback == nullptr) throw Error(ExitStatus::bad_data, fmt::format("cannot play {}", user_uri));
        playback->setRepeatEnabled(false);
        playback->setSpeed(pace == Pace::step ? -1.0F : 1.0F);
    } else if (kind == SensorKind::device) {
        pace = Pace::live;
    } else {
        device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_PACE,
                           int{pace == Pace::step ? TOUCHSTONE_PACE_STEP : TOUCHSTONE_PACE_LIVE});
    }
}

void DepthCamera::Impl::create_stream(openni::VideoStream& stream, openni::SensorType sensor,
                                      const char* what) {
    if (stream.create(device, sensor) != openni::STATUS_OK) {
        throw Error(ExitStatus::unavailable, fmt::format("{} gives no {}: {}", user_uri, what,
                                                         one_line(openni::OpenNI::getExtendedError())));
    }
    if (kind == SensorKind::device) stream.setMirroringEnabled(false);
}

void DepthCamera::Impl::find_model(const std::string& models_file) {
    const std::vector<SensorModel> models = load_sensor_models(models_file);
    const openni::DeviceInfo& info = device.getDeviceInfo();
    if (const SensorModel* found = find_sensor_model(models, info.getUsbVendorId(), info.getUsbProductId()))
        model = *found;
}

void DepthCamera::Impl::create_streams(bool with_color, const std::optional<DepthMode>& mode) {
    create_stream(depth, openni::SENSOR_DEPTH, "depth");
    if (kind == SensorKind::device)
        choose_depth_mode(depth, mode.value_or(model ? model->mode : DepthMode{}), mode.has_value());
    keeps_color = with_color && device.hasSensor(openni::SENSOR_COLOR);
    if (keeps_color)
        create_color();
    else
        pairing.finish();
}

void DepthCamera::Impl::create_color() {
    create_stream(color, openni::SENSOR_COLOR, "colour");
    if (kind == SensorKind::device) choose_color_mode(color);
    has_color = true;
}

void DepthCamera::Impl::drop_color() {
    exposure.reset();
    has_color = false;
    color.stop();
    color.destroy();
    pairing.forget_colors();
}

void DepthCamera::Impl::start_streams() {
    // Depth first: a live source begins with its first stream, and a first frame without colour is better
    // than none.
    for (openni::VideoStream* stream : {&depth, &color}) start(*stream);
}

void DepthCamera::Impl::start(openni::VideoStream& stream) {
    if (!stream.isValid() || stream.start() == openni::STATUS_OK) return;
    throw Error(ExitStatus::unavailable,
                fmt::format("{} does not start: {}", user_uri, one_line(openni::OpenNI::getExtendedError())));
}

void DepthCamera::Impl::stop_streams() {
    color.stop();
    depth.stop();
}

void DepthCamera::Impl::choose_intrinsics() {
    if (device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS, &intrinsics) == openni::STATUS_OK) return;
    intrinsics = intrinsics_from_fov(depth);
    if (!model) return;
    for (const Intrinsics& known : model->intrinsics) {
        if (known.width_px == intrinsics.width_px && known.height_px == intrinsics.height_px)
            intrinsics = known;
    }
}

void DepthCamera::Impl::take(int ready) {
    openni::VideoFrameRef frame;
    openni::VideoStream& stream = ready == 0 && has_color ? color : depth;
    if (stream.readFrame(&frame) != openni::STATUS_OK || !frame.isValid()) return;
    if (&stream == &color) {
        pairing.add(to_color_picture(frame));
    } else {
        pairing.add(to_depth_frame(frame, intrinsics));
    }
}

ReadResult DepthCamera::Impl::ending() {
    if (events.disconnected()) return CameraLost{fmt::format("{} was unplugged", name)};
    if (!events.failed()) return StreamEnd{};
    TouchstoneDriverError error{};
    if (device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_LAST_ERROR, &error) == openni::STATUS_OK) {
        throw Error(static_cast<ExitStatus>(error.exit_status), uri.in_user_terms(error.message));
    }
    return CameraLost{fmt::format("{} reports an error", name)};
}

DepthCamera::DepthCamera(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DepthCamera::DepthCamera(DepthCamera&&) noexcept = default;
DepthCamera& DepthCamera::operator=(DepthCamera&&) noexcept = default;
DepthCamera::~DepthCamera() = default;

DepthCamera DepthCamera::open(const std::string& uri, std::optional<Pace> pace, bool with_color,
                              const CameraSetup& setup) {
    return DepthCamera(std::make_unique<Impl>(uri, pace, with_color, setup));
}

ReadResult DepthCamera::read(int timeout_ms) {
    Impl& self = *impl_;
    const auto deadline = Clock::now() + std::chrono::milliseconds(timeout_ms);
    const bool stepped_recording = self.kind == SensorKind::recording && self.pace == Pace::step;
    const int longest_ms = stepped_recording ? stepped_recording_slice_ms : slice_ms;
    // Colour first: of two frames of one time OpenNI names the first stream's.
    std::array<openni::VideoStream*, 2> streams{&self.color, &self.depth};
    openni::VideoStream** const first = self.has_color ? streams.data() : streams.data() + 1;
    for (;;) {
        if (auto frame = self.pairing.take()) return *std::move(frame);
        // Asked before the wait: what came until then is still to be read.
        const bool over = self.events.any();
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        const int wait_ms = over ? 0 : std::clamp(static_cast<int>(left), 0, longest_ms);
        int ready = -1;
        const openni::Status status =
            openni::OpenNI::waitForAnyStream(first, self.has_color ? 2 : 1, &ready, wait_ms);
        if (status == openni::STATUS_OK) {
            self.take(ready);
        } else if (over) {
            self.pairing.finish();
            if (auto frame = self.pairing.take()) return *std::move(frame);
            return self.ending();
        } else if (status != openni::STATUS_TIME_OUT) {
            return CameraLost{fmt::format("{}: {}", self.name, one_line(openni::OpenNI::getExtendedError()))};
        } else if (left <= 0) {
            return ReadTimeout{};
        }
    }
}

void DepthCamera::start_recording(const std::string& path) {
    // OpenNI tells that a recorder has begun only by a file that has stopped growing, which it does not while
    // frames come.
    const bool runs_by_itself = impl_->pace == Pace::live;
    if (runs_by_itself) impl_->stop_streams();
    impl_->recording.emplace(path, impl_->depth, impl_->color);
    if (runs_by_itself) impl_->start_streams();
}

void DepthCamera::restart() {
    impl_->stop_streams();
    impl_->start_streams();
}

bool DepthCamera::can_see_color() const {
    return has_color() ||
           (impl_->kind != SensorKind::recording && impl_->device.hasSensor(openni::SENSOR_COLOR));
}

void DepthCamera::watch_color(bool watched) {
    Impl& self = *impl_;
    if (watched == self.has_color || self.keeps_color || !can_see_color()) return;
    if (!watched) {
        self.drop_color();
        return;
    }
    try {
        self.create_color();
        self.start(self.color);
    } catch (const Error&) {
        self.drop_color();
        throw;
    }
}

bool DepthCamera::hold_exposure() {
    if (!impl_->has_color) return false;
    if (!impl_->exposure) impl_->exposure.emplace(impl_->color);
    return impl_->exposure->is_held();
}

void DepthCamera::release_exposure() { impl_->exposure.reset(); }

void DepthCamera::show_light(CameraLight light) {
    const int shown = light == CameraLight::green ? TOUCHSTONE_LIGHT_GREEN
                      : light == CameraLight::red ? TOUCHSTONE_LIGHT_RED
                                                  : TOUCHSTONE_LIGHT_BLINKING_GREEN;
    if (is_device()) impl_->device.setProperty(TOUCHSTONE_DEVICE_PROPERTY_LIGHT, shown);
}

void DepthCamera::stop_recording() { impl_->recording.reset(); }

std::optional<std::uint64_t> DepthCamera::lost_packets() const {
    unsigned long long packets = 0;
    if (impl_->device.getProperty(TOUCHSTONE_DEVICE_PROPERTY_LOST_PACKETS, &packets) != openni::STATUS_OK)
        return std::nullopt;
    return packets;
}

const SensorModel* DepthCamera::model() const { return impl_->model ? &*impl_->model : nullptr; }
const Intrinsics& DepthCamera::intrinsics() const { return impl_->intrinsics; }
double DepthCamera::rate_hz() const { return impl_->depth.getVideoMode().getFps(); }
Pace DepthCamera::pace() const { return impl_->pace; }
bool DepthCamera::has_color() const { return impl_->has_color; }
bool DepthCamera::is_device() const { return impl_->kind == SensorKind::device; }
bool DepthCamera::can_return() const { return is_device() || impl_->kind == SensorKind::simulator; }
const std::string& DepthCamera::name() const { return impl_->name; }

}  // namespace touchstone
