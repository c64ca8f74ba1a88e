#include "platform/openni2_drivers/kinect/kinect_device.hpp"

#include <chrono>
#include <cstring>
#include <fmt/core.h>

#include "platform/openni2_drivers/common/property_value.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr int width_px = 640, height_px = 480, rate_hz = 30;
constexpr std::size_t pixels = std::size_t{width_px} * height_px;

StreamDescription describe(OniSensorType sensor, const Intrinsics& k) {
    const bool depth = sensor == ONI_SENSOR_DEPTH;
    StreamDescription description;
    description.sensor = sensor;
    description.mode = {depth ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888, width_px, height_px,
                        rate_hz};
    description.horizontal_fov_rad = field_of_view_rad(k.width_px, k.fx_px);
    description.vertical_fov_rad = field_of_view_rad(k.height_px, k.fy_px);
    description.can_mirror = true;
    description.max_depth_mm = farthest_depth_mm + 1;
    return description;
}

freenect_device* open_with(freenect_context* context, int index, int parts) {
    freenect_select_subdevices(context, static_cast<freenect_device_flags>(parts));
    freenect_device* device = nullptr;
    return freenect_open_device(context, &device, index) < 0 ? nullptr : device;
}

/// A Kinect whose motor hangs on its sound device (models 1473 and for Windows) opens without it.
bool motor_opened(freenect_context* context) {
    return freenect_enabled_subdevices == nullptr ||
           (freenect_enabled_subdevices(context) & FREENECT_DEVICE_MOTOR) != 0;
}

}  // namespace

KinectDevice::KinectDevice(FreenectThread& thread, int index)
    : thread_(thread), index_(index), depth_mm_(pixels), registered_mm_(pixels) {
    thread_.run([this](freenect_context* context) { open(context); });
    depth_description_ = describe(ONI_SENSOR_DEPTH, depth_intrinsics(plane_));
    color_description_ = describe(ONI_SENSOR_COLOR, color_intrinsics());
    sensors_[0] = {ONI_SENSOR_DEPTH, 1, &depth_description_.mode};
    sensors_[1] = {ONI_SENSOR_COLOR, 1, &color_description_.mode};
}

KinectDevice::~KinectDevice() {
    thread_.run([this](freenect_context*) {
        depth_.reset();
        color_.reset();
        apply_running();
        freenect_close_device(device_);
    });
}

void KinectDevice::open(freenect_context* context) {
    if (context == nullptr) throw Error(ExitStatus::unavailable, "this machine gives no access to USB");
    device_ = open_with(context, index_, FREENECT_DEVICE_CAMERA | FREENECT_DEVICE_MOTOR);
    has_motor_ = device_ != nullptr && motor_opened(context);
    if (device_ == nullptr) device_ = open_with(context, index_, FREENECT_DEVICE_CAMERA);
    if (device_ == nullptr) {
        throw Error(ExitStatus::unavailable,
                    fmt::format("Kinect {} does not open: another program has it, or this user may not; "
                                "touchstone check tells",
                                index_));
    }
    freenect_set_user(device_, this);
    freenect_set_depth_callback(device_, [](freenect_device* device, void* raw, std::uint32_t ticks) {
        static_cast<KinectDevice*>(freenect_get_user(device))->take_depth(raw, ticks);
    });
    freenect_set_video_callback(device_, [](freenect_device* device, void* rgb, std::uint32_t ticks) {
        static_cast<KinectDevice*>(freenect_get_user(device))
            ->take_color(static_cast<const std::uint8_t*>(rgb), ticks);
    });
    read_calibration();
}

void KinectDevice::read_calibration() {
    if (freenect_copy_registration != nullptr && freenect_destroy_registration != nullptr) {
        freenect_registration theirs = freenect_copy_registration(device_);
        const freenect_zero_plane_info& zero = theirs.zero_plane_info;
        if (zero.reference_distance > 0 && zero.reference_pixel_size > 0 && zero.dcmos_emitter_dist > 0) {
            plane_ = {zero.dcmos_emitter_dist, zero.dcmos_rcmos_dist, zero.reference_distance,
                      zero.reference_pixel_size, theirs.const_shift};
            for (std::size_t i = 0; i < pixels; ++i)
                tables_.places.push_back({theirs.registration_table[i][0], theirs.registration_table[i][1]});
            tables_.shifts_x.assign(theirs.depth_to_rgb_shift,
                                    theirs.depth_to_rgb_shift + FREENECT_DEPTH_MM_MAX_VALUE);
            tables_.first_row = theirs.reg_pad_info.start_lines;
        }
        freenect_destroy_registration(&theirs);
    }
    if (tables_.places.empty()) tables_ = nominal_registration(plane_);
    table_ = depth_table(plane_);
}

bool KinectDevice::lose() {
    const bool was_running = depth_on_ || color_on_;
    for (bool* on : {&depth_on_, &color_on_}) {
        if (*on) thread_.stream_stopped();
        *on = false;
    }
    return was_running;
}

OniStatus KinectDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
    *sensors = sensors_;
    *count = 2;
    return ONI_STATUS_OK;
}

oni::driver::StreamBase* KinectDevice::createStream(OniSensorType sensor) {
    if (sensor != ONI_SENSOR_DEPTH && sensor != ONI_SENSOR_COLOR) return nullptr;
    const bool depth = sensor == ONI_SENSOR_DEPTH;
    return thread_.run([&](freenect_context*) {
        auto& stream = depth ? depth_ : color_;
        stream = std::make_unique<SourceStream>(depth ? depth_description_ : color_description_, [this] {
            return thread_.run([this](freenect_context*) { return apply_running(); });
        });
        if (!depth && freenect_set_flag != nullptr)
            stream->offer_automatics(
                [this](CameraAutomatic what, bool on) { return switch_automatic(what, on); });
        return stream.get();
    });
}

void KinectDevice::destroyStream(oni::driver::StreamBase* stream) {
    thread_.run([&](freenect_context*) {
        if (stream == depth_.get()) depth_.reset();
        if (stream == color_.get()) color_.reset();
        apply_running();
    });
}

bool KinectDevice::apply_running() {
    const bool depth = depth_ && depth_->running(), color = color_ && color_->running();
    bool fine = true;
    if (depth && !depth_on_) fine = depth_on_ = start_depth();
    if (color && !color_on_) fine = (color_on_ = start_color()) && fine;
    if (!depth && depth_on_) {
        freenect_stop_depth(device_);
        thread_.stream_stopped();
        depth_on_ = false;
    }
    if (!color && color_on_) {
        freenect_stop_video(device_);
        thread_.stream_stopped();
        color_on_ = false;
    }
    return fine;
}

bool KinectDevice::start_depth() {
    const auto mode = freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_DEPTH_11BIT);
    if (freenect_set_depth_mode(device_, mode) < 0 || freenect_start_depth(device_) < 0) return false;
    thread_.stream_started();
    return true;
}

bool KinectDevice::start_color() {
    const auto mode = freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
    if (freenect_set_video_mode(device_, mode) < 0 || freenect_start_video(device_) < 0) return false;
    thread_.stream_started();
    return true;
}

std::uint64_t KinectDevice::time_us(std::uint32_t ticks) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
    return clock_.time_us(ticks, static_cast<std::uint64_t>(now_us));
}

void KinectDevice::take_depth(const void* raw, std::uint32_t ticks) {
    if (!depth_ || !depth_->running()) return;
    // A copy: a replayed picture stands at an odd address behind its header.
    std::memcpy(depth_mm_.data(), raw, sizeof(std::uint16_t) * pixels);
    for (std::uint16_t& value : depth_mm_) value = table_[value % raw_depth_values];
    if (registered_) register_depth(depth_mm_, tables_, registered_mm_);
    const auto& picture = registered_ ? registered_mm_ : depth_mm_;
    depth_->deliver(picture.data(), 2 * pixels, ++depth_frames_, time_us(ticks));
}

void KinectDevice::take_color(const std::uint8_t* rgb, std::uint32_t ticks) {
    if (color_ && color_->running()) color_->deliver(rgb, 3 * pixels, ++color_frames_, time_us(ticks));
}

}  // namespace touchstone
