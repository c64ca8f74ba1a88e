#include "platform/openni2_drivers/common/source_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "platform/openni2_drivers/common/property_value.hpp"

namespace touchstone {
namespace {

int pixel_bytes(const OniVideoMode& mode) { return mode.pixelFormat == ONI_PIXEL_FORMAT_RGB888 ? 3 : 2; }

int stride_bytes(const OniVideoMode& mode) { return mode.resolutionX * pixel_bytes(mode); }

bool same_mode(const OniVideoMode& a, const OniVideoMode& b) {
    return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX &&
           a.resolutionY == b.resolutionY && a.fps == b.fps;
}

/// A row from its last pixel to its first.
void reverse_row(const std::byte* row, std::byte* target, std::size_t pixels, std::size_t bytes_each) {
    for (std::size_t x = 0; x < pixels; ++x)
        std::memcpy(target + x * bytes_each, row + (pixels - 1 - x) * bytes_each, bytes_each);
}

std::optional<CameraAutomatic> automatic_of(int property) {
    if (property == ONI_STREAM_PROPERTY_AUTO_EXPOSURE) return CameraAutomatic::exposure;
    if (property == ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE) return CameraAutomatic::white_balance;
    return std::nullopt;
}

}  // namespace

float field_of_view_rad(int size_px, float focal_px) {
    return 2.0F * std::atan(static_cast<float>(size_px) / (2.0F * focal_px));
}

SourceStream::SourceStream(const StreamDescription& description, std::function<bool()> running_changed)
    : description_(description), running_changed_(std::move(running_changed)) {}

OniStatus SourceStream::start() {
    running_ = true;
    if (running_changed_()) return ONI_STATUS_OK;
    running_ = false;
    return ONI_STATUS_ERROR;
}

void SourceStream::stop() {
    running_ = false;
    running_changed_();
}

void SourceStream::offer_automatics(std::function<bool(CameraAutomatic, bool)> switch_camera) {
    switch_camera_ = std::move(switch_camera);
}

OniStatus SourceStream::switch_automatic(CameraAutomatic what, const void* data, int size) {
    const auto wanted = take_property<OniBool>(data, size);
    if (!wanted) return ONI_STATUS_BAD_PARAMETER;
    const bool on = *wanted != FALSE;
    if (!switch_camera_(what, on)) return ONI_STATUS_ERROR;
    is_on(what) = on;
    return ONI_STATUS_OK;
}

OniStatus SourceStream::getProperty(int id, void* data, int* size) {
    if (const auto what = automatic_of(id); what && switch_camera_)
        return give_property(OniBool{is_on(*what) ? TRUE : FALSE}, data, size);
    const OniVideoMode& mode = description_.mode;
    switch (id) {
        case ONI_STREAM_PROPERTY_VIDEO_MODE:
            return give_property(mode, data, size);
        case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
            return give_property(description_.horizontal_fov_rad, data, size);
        case ONI_STREAM_PROPERTY_VERTICAL_FOV:
            return give_property(description_.vertical_fov_rad, data, size);
        case ONI_STREAM_PROPERTY_STRIDE:
            return give_property(stride_bytes(mode), data, size);
        case ONI_STREAM_PROPERTY_MIRRORING:
            return give_property(OniBool{mirrored_ ? TRUE : FALSE}, data, size);
        case ONI_STREAM_PROPERTY_CROPPING:  // the stock player shows nothing of a recording without this
                                            // property
            return give_property(OniCropping{FALSE, 0, 0, mode.resolutionX, mode.resolutionY}, data, size);
        case ONI_STREAM_PROPERTY_MAX_VALUE:
            if (description_.sensor == ONI_SENSOR_DEPTH)
                return give_property(description_.max_depth_mm, data, size);
            break;
        case ONI_STREAM_PROPERTY_MIN_VALUE:
            if (description_.sensor == ONI_SENSOR_DEPTH) return give_property(0, data, size);
            break;
        default:
            break;
    }
    return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus SourceStream::setProperty(int id, const void* data, int size) {
    if (const auto what = automatic_of(id); what && switch_camera_)
        return switch_automatic(*what, data, size);
    if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
        const auto mode = take_property<OniVideoMode>(data, size);
        return mode && same_mode(*mode, description_.mode) ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
    }
    if (id == ONI_STREAM_PROPERTY_MIRRORING) {
        const auto mirrored = take_property<OniBool>(data, size);
        if (!mirrored || (*mirrored != FALSE && !description_.can_mirror)) return ONI_STATUS_NOT_SUPPORTED;
        mirrored_ = *mirrored != FALSE;
        return ONI_STATUS_OK;
    }
    return ONI_STATUS_NOT_SUPPORTED;
}

OniBool SourceStream::isPropertySupported(int id) {
    switch (id) {
        case ONI_STREAM_PROPERTY_VIDEO_MODE:
        case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        case ONI_STREAM_PROPERTY_STRIDE:
        case ONI_STREAM_PROPERTY_MIRRORING:
            return TRUE;
        case ONI_STREAM_PROPERTY_MAX_VALUE:
        case ONI_STREAM_PROPERTY_MIN_VALUE:
            return description_.sensor == ONI_SENSOR_DEPTH;
        case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
        case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
            return switch_camera_ ? TRUE : FALSE;
        default:
            return FALSE;
    }
}

void SourceStream::notifyAllProperties() {
    raisePropertyChanged(ONI_STREAM_PROPERTY_HORIZONTAL_FOV, &description_.horizontal_fov_rad, sizeof(float));
    raisePropertyChanged(ONI_STREAM_PROPERTY_VERTICAL_FOV, &description_.vertical_fov_rad, sizeof(float));
    raisePropertyChanged(ONI_STREAM_PROPERTY_VIDEO_MODE, &description_.mode, sizeof(OniVideoMode));
}

void SourceStream::set_field_of_view(float horizontal_rad, float vertical_rad) {
    description_.horizontal_fov_rad = horizontal_rad;
    description_.vertical_fov_rad = vertical_rad;
    notifyAllProperties();
}

void SourceStream::copy_rows(const void* pixels, std::size_t bytes, void* target) const {
    if (!mirrored_) {
        std::memcpy(target, pixels, bytes);
        return;
    }
    const auto width = static_cast<std::size_t>(description_.mode.resolutionX);
    const auto bytes_each = static_cast<std::size_t>(pixel_bytes(description_.mode));
    const std::size_t stride = width * bytes_each;
    for (std::size_t at = 0; at + stride <= bytes; at += stride) {
        reverse_row(static_cast<const std::byte*>(pixels) + at, static_cast<std::byte*>(target) + at, width,
                    bytes_each);
    }
}

void SourceStream::deliver(const void* pixels, std::size_t bytes, int index, std::uint64_t timestamp_us) {
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    const OniVideoMode& mode = description_.mode;
    const auto capacity =
        static_cast<std::size_t>(stride_bytes(mode)) * static_cast<std::size_t>(mode.resolutionY);
    const std::size_t size = std::min(bytes, capacity);
    if (size > 0) copy_rows(pixels, size, frame->data);
    std::memset(static_cast<std::byte*>(frame->data) + size, 0, capacity - size);
    frame->dataSize = static_cast<int>(size);
    frame->sensorType = description_.sensor;
    frame->timestamp = timestamp_us;
    frame->frameIndex = index;
    frame->width = mode.resolutionX;
    frame->height = mode.resolutionY;
    frame->videoMode = mode;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = 0;
    frame->cropOriginY = 0;
    frame->stride = stride_bytes(mode);
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
}

}  // namespace touchstone
