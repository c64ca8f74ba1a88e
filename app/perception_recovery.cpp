// How the perception loop opens a camera, and brings one back that is silent, frozen or blind.
#include <algorithm>
#include <cmath>

#include "app/configured_camera.hpp"
#include "app/perception.hpp"
#include "platform/system/log.hpp"
#include "platform/usb/depth_cameras.hpp"

namespace touchstone {
namespace {

std::uint64_t host_time_us() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

/// A simulation without noise is frozen wherever nothing moves.
bool is_watched(const DepthCamera& camera, const std::string& uri) {
    return camera.is_device() || (uri.starts_with("sim:") && uri.find("noise=0") == std::string::npos);
}

void keep_cameras_awake() {
    try {
        for (const UsbDepthCamera& camera : find_depth_cameras(list_usb_devices()))
            if (camera.device.autosuspend && !keep_awake(camera.device))
                log_info("{} may be put to sleep by the kernel: touchstone check tells what to do",
                         camera.model);
    } catch (const Error&) {
        // Without a view of USB the camera works as well.
    }
}

void reset_on_usb() {
    try {
        for (const UsbDepthCamera& camera : find_depth_cameras(list_usb_devices())) {
            if (camera.state != UsbCameraState::ready) continue;
            log_warning("resetting {} at USB {}", camera.model, camera.device.name());
            reset_usb_device(camera.device);
        }
    } catch (const Error& error) {
        log_warning("{}", error.what());
    }
}

}  // namespace

void Perception::open_camera() {
    const bool with_color = wants_color(options_.config);
    camera_ = configured_camera(options_.config, options_.pace, with_color);
    if (with_color && !camera_->has_color())
        log_warning("{} gives no colours: surfaces are shown shaded", camera_->name());
    const std::chrono::milliseconds three_frames(std::lround(3000.0 / camera_->rate_hz()));
    recovery_.opened(std::chrono::steady_clock::now(),
                     std::max(three_frames, std::chrono::milliseconds(500)));
    judge_ = FrameJudge();
    health_.camera_opened();
    light_state_.clear();
    if (camera_->is_device()) keep_cameras_awake();
    log_info("reading {}{}", camera_->name(), camera_->model() ? ", a " + camera_->model()->name : "");
}

void Perception::drop_camera() {
    projector_.give_up("the camera is lost");
    camera_.reset();
    release_touches();
}

void Perception::release_touches() {
    if (pipeline_) pipeline_->release_touches();
    outputs_.release_all();
}

std::optional<CameraFault> Perception::fault_of(DepthFrame& frame) {
    if (camera_->pace() != Pace::live || !is_watched(*camera_, options_.config.sensor_uri))
        return std::nullopt;
    const int jumps = time_.jumps();
    frame.timestamp_us = time_.steady_us(frame.timestamp_us, host_time_us());
    if (time_.jumps() != jumps) {
        log_warning("{}: its clock has jumped", camera_->name());
        note_fault("clock", "the camera's clock has jumped");
    }
    switch (judge_.judge(frame)) {
        case FrameHealth::frozen:
            return frozen_camera;
        case FrameHealth::blind:
            return blind_camera;
        case FrameHealth::torn:
            log_warning("{}: half of a picture is from the one before", camera_->name());
            note_fault("torn", "half of a picture is from the one before");
            return torn_camera;
        case FrameHealth::good:
            break;
    }
    return std::nullopt;
}

TableFrame Perception::without_camera(const std::string& reason) {
    log_warning("{}", reason);
    note_fault("lost", reason);
    if (fault_reports_) fault_reports_->report("lost");
    drop_camera();
    recovery_.lost(std::chrono::steady_clock::now());
    return without_frame("sensor_lost", "The depth camera is gone: " + reason);
}

TableFrame Perception::without_good_frame(const CameraFault& fault) {
    if (camera_->can_return() && camera_->pace() == Pace::live) help_camera(fault);
    outputs_.idle();
    if (recovery_.ailing() && pipeline_) return without_frame("sensor_lost", std::string(fault.text));
    return last_shown_.state.empty() ? without_frame("starting", "") : last_shown_;
}

void Perception::help_camera(const CameraFault& fault) {
    const bool ailed = recovery_.ailing();
    const Remedy remedy = recovery_.due(std::chrono::steady_clock::now());
    if (remedy == Remedy::none) return;
    if (!ailed) {
        log_warning("{}: {}; restarting its stream", camera_->name(), fault.text);
        if (fault_reports_) fault_reports_->report(fault.word);
        if (fault.word != torn_camera.word) note_fault(std::string(fault.word), std::string(fault.text));
        release_touches();
        show_light("sensor_lost");
    }
    try {
        if (remedy == Remedy::restart_stream) {
            health_.restart("stream");
            camera_->restart();
            return;
        }
    } catch (const Error& error) {
        log_warning("{}", error.what());
    }
    log_warning("{}: opening it anew", camera_->name());
    health_.restart("camera");
    const bool on_usb = camera_->is_device();
    drop_camera();
    if (remedy != Remedy::reset_and_reopen || !on_usb) return;
    health_.restart("usb");
    reset_on_usb();
}

void Perception::show_light(const std::string& state) {
    if (!camera_ || state == light_state_) return;
    light_state_ = state;
    camera_->show_light(state == "live"          ? CameraLight::green
                        : state == "sensor_lost" ? CameraLight::red
                                                 : CameraLight::blinking_green);
}

}  // namespace touchstone
