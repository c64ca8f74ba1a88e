#include "platform/openni2_drivers/common/source_device.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>

#include "platform/openni2_drivers/common/property_value.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto longest_sleep = std::chrono::milliseconds(20);

StreamDescription describe(const SourceInfo& info, OniSensorType sensor) {
    const bool depth = sensor == ONI_SENSOR_DEPTH;
    const Intrinsics& k = info.intrinsics;
    OniVideoMode mode{};
    mode.pixelFormat = depth ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888;
    mode.resolutionX = depth ? k.width_px : info.color_width_px;
    mode.resolutionY = depth ? k.height_px : info.color_height_px;
    mode.fps = static_cast<int>(std::lround(info.rate_hz));
    return {sensor, mode, field_of_view_rad(k.width_px, k.fx_px), field_of_view_rad(k.height_px, k.fy_px)};
}

TouchstoneDriverError driver_error(ExitStatus status, const char* message) {
    TouchstoneDriverError error{};
    error.exit_status = static_cast<int>(status);
    std::snprintf(error.message, sizeof error.message, "%s", message);
    return error;
}

}  // namespace

SourceDevice::SourceDevice(std::unique_ptr<FrameSource> source,
                           std::function<void(OniDeviceState)> state_changed,
                           std::function<void(double)> unplugged)
    : source_(std::move(source)),
      info_(source_->info()),
      state_changed_(std::move(state_changed)),
      unplugged_(std::move(unplugged)),
      depth_description_(describe(info_, ONI_SENSOR_DEPTH)),
      color_description_(describe(info_, ONI_SENSOR_COLOR)),
      pace_(info_.default_pace) {
    sensors_[0] = {ONI_SENSOR_DEPTH, 1, &depth_description_.mode};
    sensors_[1] = {ONI_SENSOR_COLOR, 1, &color_description_.mode};
    source_->enable_color(false);
}

SourceDevice::~SourceDevice() {
    live_ = false;
    if (live_thread_.joinable()) live_thread_.join();
}

OniStatus SourceDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
    *sensors = sensors_;
    *count = info_.has_color ? 2 : 1;
    return ONI_STATUS_OK;
}

oni::driver::StreamBase* SourceDevice::createStream(OniSensorType sensor) {
    const bool depth = sensor == ONI_SENSOR_DEPTH;
    if (!depth && (sensor != ONI_SENSOR_COLOR || !info_.has_color)) return nullptr;
    const std::lock_guard lock(mutex_);
    auto& stream = depth ? depth_ : color_;
    stream = std::make_unique<SourceStream>(depth ? depth_description_ : color_description_, [this] {
        running_changed();
        return true;
    });
    if (!depth && info_.has_automatics) stream->offer_automatics([](CameraAutomatic, bool) { return true; });
    return stream.get();
}

void SourceDevice::destroyStream(oni::driver::StreamBase* stream) {
    const std::lock_guard lock(mutex_);
    if (stream == depth_.get()) depth_.reset();
    if (stream == color_.get()) color_.reset();
}

OniStatus SourceDevice::getProperty(int id, void* data, int* size) {
    const std::lock_guard lock(mutex_);
    switch (id) {
        case TOUCHSTONE_DEVICE_PROPERTY_PACE:
            return give_property(int{pace_ == Pace::step ? TOUCHSTONE_PACE_STEP : TOUCHSTONE_PACE_LIVE}, data,
                                 size);
        case TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS:
            return give_property(info_.intrinsics, data, size);
        case TOUCHSTONE_DEVICE_PROPERTY_LAST_ERROR:
            return give_property(error_, data, size);
        case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
            return give_property(ONI_IMAGE_REGISTRATION_OFF, data, size);
        default:
            return ONI_STATUS_NOT_SUPPORTED;
    }
}

OniStatus SourceDevice::setProperty(int id, const void* data, int size) {
    if (id != TOUCHSTONE_DEVICE_PROPERTY_PACE) return ONI_STATUS_NOT_SUPPORTED;
    const auto pace = take_property<int>(data, size);
    if (!pace || (*pace != TOUCHSTONE_PACE_LIVE && *pace != TOUCHSTONE_PACE_STEP))
        return ONI_STATUS_BAD_PARAMETER;
    const std::lock_guard lock(mutex_);
    if (any_stream_runs()) return ONI_STATUS_OUT_OF_FLOW;
    pace_ = *pace == TOUCHSTONE_PACE_STEP ? Pace::step : Pace::live;
    return ONI_STATUS_OK;
}

OniBool SourceDevice::isPropertySupported(int id) {
    return id == TOUCHSTONE_DEVICE_PROPERTY_PACE || id == TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS ||
           id == TOUCHSTONE_DEVICE_PROPERTY_LAST_ERROR;
}

OniStatus SourceDevice::tryManualTrigger() {
    if (pace_ == Pace::step) deliver_next();
    return ONI_STATUS_OK;
}

bool SourceDevice::any_stream_runs() const {
    return (depth_ && depth_->running()) || (color_ && color_->running());
}

void SourceDevice::running_changed() {
    bool run = false;
    {
        const std::lock_guard lock(mutex_);
        source_->enable_color(color_ && color_->running());
        run = any_stream_runs() && pace_ == Pace::live && !ended_;
        if (run && !live_ && std::exchange(has_run_, true)) source_->restarted();
    }
    if (run == live_) return;
    live_ = run;
    if (live_thread_.joinable()) live_thread_.join();
    if (run) live_thread_ = std::thread([this] { run_live(); });
}

void SourceDevice::run_live() {
    const auto period =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / info_.rate_hz));
    auto due = Clock::now();
    while (live_) {
        const auto now = Clock::now();
        if (now < due) {
            std::this_thread::sleep_until(std::min(due, now + longest_sleep));
            continue;
        }
        if (!deliver_next()) return;
        due += period * (1 + (Clock::now() - due) / period);
    }
}

bool SourceDevice::deliver_next() {
    Outcome outcome;
    {
        const std::lock_guard lock(mutex_);
        if (ended_) return false;
        outcome = make_frame();
        ended_ = outcome != Outcome::delivered;
    }
    // Without the lock: a listener may ask for properties.
    if (outcome == Outcome::end) state_changed_(ONI_DEVICE_STATE_EOF);
    if (outcome == Outcome::failed) state_changed_(ONI_DEVICE_STATE_ERROR);
    if (outcome == Outcome::unplugged && unplugged_) unplugged_(*frame_.back_after_s);
    return outcome == Outcome::delivered;
}

SourceDevice::Outcome SourceDevice::make_frame() {
    try {
        if (!source_->next(frame_)) return Outcome::end;
    } catch (const Error& error) {
        error_ = driver_error(error.status(), error.what());
        return Outcome::failed;
    } catch (const std::exception& error) {
        error_ = driver_error(ExitStatus::bad_data, error.what());
        return Outcome::failed;
    }
    if (frame_.back_after_s) return Outcome::unplugged;
    if (frame_.withheld) return Outcome::delivered;
    if (color_ && color_->running()) {
        color_->deliver(frame_.color_rgb.data(), frame_.color_rgb.size(), frame_.index, frame_.timestamp_us);
    }
    if (depth_ && depth_->running()) {
        depth_->deliver(frame_.depth_mm.data(), 2 * frame_.depth_mm.size(), frame_.index,
                        frame_.timestamp_us);
    }
    return Outcome::delivered;
}

}  // namespace touchstone
