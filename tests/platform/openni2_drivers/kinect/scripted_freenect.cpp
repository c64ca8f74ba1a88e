#include "tests/platform/openni2_drivers/kinect/scripted_freenect.hpp"

#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <libfreenect.h>
#include <libfreenect_registration.h>
#include <thread>
#include <vector>

using touchstone::ScriptedFreenect;

struct _freenect_context {
    int flags;
    freenect_log_cb log = nullptr;
    freenect_loglevel level = FREENECT_LOG_WARNING;
};
struct _freenect_device {
    void* user = nullptr;
    freenect_depth_cb depth = nullptr;
    freenect_video_cb video = nullptr;
    freenect_raw_tilt_state tilt{};
    bool depth_on = false, video_on = false;
};

namespace {

ScriptedFreenect& script() { return ScriptedFreenect::instance(); }

/// The devices that are open, for process_events; one thread only.
std::vector<freenect_device*>& open_devices() {
    static std::vector<freenect_device*> devices;
    return devices;
}

freenect_frame_mode mode_of(int bytes) {
    freenect_frame_mode mode{};
    mode.bytes = bytes;
    mode.width = 640;
    mode.height = 480;
    mode.is_valid = 1;
    return mode;
}

void send_pictures(freenect_device* device) {
    const std::uint32_t ticks = script().ticks.fetch_add(2'000'000);
    if (device->video_on) {
        std::vector<std::uint8_t> rgb(3 * 640 * 480, 9);
        rgb[0] = 1, rgb[1] = 2, rgb[2] = 3;
        device->video(device, rgb.data(), ticks);
    }
    if (device->depth_on) {
        std::vector<std::uint16_t> raw(640 * 480, script().raw);
        raw[0] = FREENECT_DEPTH_RAW_NO_VALUE;
        device->depth(device, raw.data(), ticks);
    }
}

/// In libfreenect's words.
void tell_lost_packets(freenect_context* context) {
    const int packets = script().loses_packets.exchange(0);
    if (packets == 0 || context->log == nullptr || context->level < FREENECT_LOG_INFO) return;
    context->log(context, FREENECT_LOG_INFO, fmt::format("[Stream 70] Lost {} packets\n", packets).c_str());
    context->log(context, FREENECT_LOG_INFO,
                 "[Stream 70] Lost 999 total packets in 100 frames (9.99 lppf)\n");
    context->log(context, FREENECT_LOG_INFO, "[Stream 70] Lost too many packets, resyncing...\n");
}

}  // namespace

ScriptedFreenect& ScriptedFreenect::instance() {
    static ScriptedFreenect only;
    return only;
}

extern "C" {

int freenect_init(freenect_context** context, freenect_usb_context*) {
    *context = new freenect_context{};
    ++script().contexts;
    return 0;
}
int freenect_shutdown(freenect_context* context) {
    delete context;
    --script().contexts;
    return 0;
}
void freenect_set_log_callback(freenect_context* context, freenect_log_cb callback) {
    context->log = callback;
}
void freenect_set_log_level(freenect_context* context, freenect_loglevel level) { context->level = level; }
void freenect_select_subdevices(freenect_context* context, freenect_device_flags flags) {
    context->flags = flags;
}
freenect_device_flags freenect_enabled_subdevices(freenect_context* context) {
    return static_cast<freenect_device_flags>(context->flags);
}
int freenect_num_devices(freenect_context*) { return script().devices; }
int freenect_open_device(freenect_context* context, freenect_device** device, int index) {
    if (index >= script().devices || !script().opens) return -1;
    if (!script().has_motor) context->flags &= ~FREENECT_DEVICE_MOTOR;
    *device = new freenect_device;
    open_devices().push_back(*device);
    ++script().opened;
    return 0;
}
int freenect_close_device(freenect_device* device) {
    std::erase(open_devices(), device);
    delete device;
    --script().opened;
    return 0;
}
void freenect_set_user(freenect_device* device, void* user) { device->user = user; }
void* freenect_get_user(freenect_device* device) { return device->user; }
void freenect_set_depth_callback(freenect_device* device, freenect_depth_cb callback) {
    device->depth = callback;
}
void freenect_set_video_callback(freenect_device* device, freenect_video_cb callback) {
    device->video = callback;
}
freenect_frame_mode freenect_find_depth_mode(freenect_resolution, freenect_depth_format) {
    return mode_of(2 * 640 * 480);
}
freenect_frame_mode freenect_find_video_mode(freenect_resolution, freenect_video_format) {
    return mode_of(3 * 640 * 480);
}
int freenect_set_depth_mode(freenect_device*, freenect_frame_mode) { return 0; }
int freenect_set_video_mode(freenect_device*, freenect_frame_mode) { return 0; }
int freenect_start_depth(freenect_device* device) {
    if (!script().starts) return -1;
    device->depth_on = true;
    ++script().depth_streams;
    return 0;
}
int freenect_start_video(freenect_device* device) {
    if (!script().starts) return -1;
    device->video_on = true;
    ++script().color_streams;
    ++script().color_starts;
    return 0;
}
int freenect_stop_depth(freenect_device* device) {
    if (device->depth_on) --script().depth_streams;
    device->depth_on = false;
    return 0;
}
int freenect_stop_video(freenect_device* device) {
    if (device->video_on) --script().color_streams;
    device->video_on = false;
    return 0;
}
int freenect_process_events_timeout(freenect_context* context, timeval*) {
    tell_lost_packets(context);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (script().gone) {
        for (freenect_device* device : open_devices()) {
            freenect_stop_depth(device);
            freenect_stop_video(device);
        }
        return -1;
    }
    for (freenect_device* device : open_devices()) send_pictures(device);
    return 0;
}
freenect_registration freenect_copy_registration(freenect_device*) {
    ++script().registrations;
    freenect_registration copy{};
    copy.raw_to_mm_shift = static_cast<std::uint16_t*>(std::calloc(2048, 2));
    copy.depth_to_rgb_shift = static_cast<std::int32_t*>(std::calloc(10'000, 4));
    copy.registration_table = static_cast<std::int32_t(*)[2]>(std::calloc(640 * 480, 8));
    if (!script().own_calibration) return copy;
    copy.zero_plane_info = {7.5F, 2.3F, 60.0F, 0.1042F};
    copy.const_shift = 200;
    for (int i = 0; i < 640 * 480; ++i) {
        copy.registration_table[i][0] = (i % 640 + 1) * 256;
        copy.registration_table[i][1] = i / 640;
    }
    return copy;
}
int freenect_destroy_registration(freenect_registration* copy) {
    --script().registrations;
    std::free(copy->raw_to_mm_shift);
    std::free(copy->depth_to_rgb_shift);
    std::free(copy->registration_table);
    return 0;
}
int freenect_update_tilt_state(freenect_device* device) {
    device->tilt.accelerometer_x = 27;
    device->tilt.accelerometer_y = 805;
    device->tilt.accelerometer_z = 190;
    device->tilt.tilt_angle = static_cast<std::int8_t>(2 * script().tilt_deg);
    return 0;
}
freenect_raw_tilt_state* freenect_get_tilt_state(freenect_device* device) { return &device->tilt; }
double freenect_get_tilt_degs(freenect_raw_tilt_state* state) { return state->tilt_angle / 2.0; }
int freenect_set_tilt_degs(freenect_device*, double degrees) {
    script().tilt_deg = degrees;
    return 0;
}
int freenect_set_flag(freenect_device*, freenect_flag flag, freenect_flag_value value) {
    if (!script().takes_flags) return -1;
    if (flag == FREENECT_AUTO_EXPOSURE) script().auto_exposure = value;
    if (flag == FREENECT_AUTO_WHITE_BALANCE) script().auto_white_balance = value;
    return 0;
}
int freenect_set_led(freenect_device*, freenect_led_options led) {
    script().led = led;
    return 0;
}

}  // extern "C"
