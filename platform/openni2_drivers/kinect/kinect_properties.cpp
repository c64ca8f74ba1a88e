#include <cmath>

#include "platform/openni2_drivers/common/property_value.hpp"
#include "platform/openni2_drivers/kinect/kinect_device.hpp"

namespace touchstone {
namespace {

constexpr float farthest_tilt_deg = 30.0F;
constexpr float standard_gravity = 9.80665F;

std::optional<freenect_led_options> led_of(int light) {
    switch (light) {
        case TOUCHSTONE_LIGHT_OFF:
            return LED_OFF;
        case TOUCHSTONE_LIGHT_GREEN:
            return LED_GREEN;
        case TOUCHSTONE_LIGHT_BLINKING_GREEN:
            return LED_BLINK_GREEN;
        case TOUCHSTONE_LIGHT_RED:
            return LED_RED;
        default:
            return std::nullopt;
    }
}

/// The sensor's axes are the camera's turned by half a turn about z, and at rest it feels the floor's push.
TouchstoneVector gravity_of(const freenect_raw_tilt_state& state) {
    constexpr float per_count = standard_gravity / FREENECT_COUNTS_PER_G;
    return {per_count * state.accelerometer_x, per_count * state.accelerometer_y,
            -per_count * state.accelerometer_z};
}

bool is_motor_property(int id) {
    return id == TOUCHSTONE_DEVICE_PROPERTY_LIGHT || id == TOUCHSTONE_DEVICE_PROPERTY_TILT ||
           id == TOUCHSTONE_DEVICE_PROPERTY_GRAVITY;
}

}  // namespace

OniStatus KinectDevice::getProperty(int id, void* data, int* size) {
    if (id == TOUCHSTONE_DEVICE_PROPERTY_LOST_PACKETS)
        return give_property(static_cast<unsigned long long>(thread_.lost_packets()), data, size);
    return thread_.run([&](freenect_context*) { return get(id, data, size); });
}

OniStatus KinectDevice::setProperty(int id, const void* data, int size) {
    return thread_.run([&](freenect_context*) { return set(id, data, size); });
}

OniBool KinectDevice::isPropertySupported(int id) {
    return id == TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS || id == TOUCHSTONE_DEVICE_PROPERTY_LOST_PACKETS ||
           id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || (has_motor_ && is_motor_property(id));
}

OniBool KinectDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
    return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}

Intrinsics KinectDevice::intrinsics() const {
    return registered_ ? color_intrinsics() : depth_intrinsics(plane_);
}

OniStatus KinectDevice::get(int id, void* data, int* size) {
    if (id == TOUCHSTONE_DEVICE_PROPERTY_INTRINSICS) return give_property(intrinsics(), data, size);
    if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) {
        return give_property(registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF,
                             data, size);
    }
    if (!has_motor_ || !is_motor_property(id)) return ONI_STATUS_NOT_SUPPORTED;
    if (id == TOUCHSTONE_DEVICE_PROPERTY_LIGHT) return give_property(light_, data, size);
    return get_motion(id, data, size);
}

OniStatus KinectDevice::get_motion(int id, void* data, int* size) {
    if (freenect_update_tilt_state(device_) < 0) return ONI_STATUS_ERROR;
    freenect_raw_tilt_state* state = freenect_get_tilt_state(device_);
    if (id == TOUCHSTONE_DEVICE_PROPERTY_GRAVITY) return give_property(gravity_of(*state), data, size);
    return give_property(static_cast<float>(freenect_get_tilt_degs(state)), data, size);
}

OniStatus KinectDevice::set(int id, const void* data, int size) {
    if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return set_registered(data, size);
    if (!has_motor_) return ONI_STATUS_NOT_SUPPORTED;
    if (id == TOUCHSTONE_DEVICE_PROPERTY_LIGHT) return set_light(data, size);
    if (id == TOUCHSTONE_DEVICE_PROPERTY_TILT) return set_tilt(data, size);
    return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus KinectDevice::set_registered(const void* data, int size) {
    const auto mode = take_property<OniImageRegistrationMode>(data, size);
    if (!mode || !isImageRegistrationModeSupported(*mode)) return ONI_STATUS_BAD_PARAMETER;
    registered_ = *mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    const Intrinsics k = intrinsics();
    depth_description_.horizontal_fov_rad = field_of_view_rad(k.width_px, k.fx_px);
    depth_description_.vertical_fov_rad = field_of_view_rad(k.height_px, k.fy_px);
    if (depth_) {
        depth_->set_field_of_view(depth_description_.horizontal_fov_rad, depth_description_.vertical_fov_rad);
    }
    return ONI_STATUS_OK;
}

bool KinectDevice::switch_automatic(CameraAutomatic what, bool on) {
    const freenect_flag flag =
        what == CameraAutomatic::exposure ? FREENECT_AUTO_EXPOSURE : FREENECT_AUTO_WHITE_BALANCE;
    return thread_.run([&](freenect_context*) {
        return freenect_set_flag(device_, flag, on ? FREENECT_ON : FREENECT_OFF) >= 0;
    });
}

OniStatus KinectDevice::set_light(const void* data, int size) {
    const auto light = take_property<int>(data, size);
    const auto led = light ? led_of(*light) : std::nullopt;
    if (!led) return ONI_STATUS_BAD_PARAMETER;
    if (freenect_set_led(device_, *led) < 0) return ONI_STATUS_ERROR;
    light_ = *light;
    return ONI_STATUS_OK;
}

OniStatus KinectDevice::set_tilt(const void* data, int size) {
    const auto degrees = take_property<float>(data, size);
    if (!degrees || !(std::abs(*degrees) <= farthest_tilt_deg)) return ONI_STATUS_BAD_PARAMETER;
    return freenect_set_tilt_degs(device_, *degrees) < 0 ? ONI_STATUS_ERROR : ONI_STATUS_OK;
}

}  // namespace touchstone
