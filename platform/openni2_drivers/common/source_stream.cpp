#include "platform/openni2_drivers/common/source_stream.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "platform/openni2_drivers/common/property_value.hpp"

namespace touchstone {
namespace {

// The recorder's depth codec turns values that are not below this one into others. 65535 itself never occurs:
// it means invalid in several data sets.
constexpr int max_depth_mm = 65535;

int stride_bytes(const OniVideoMode& mode) {
    return mode.resolutionX * (mode.pixelFormat == ONI_PIXEL_FORMAT_RGB888 ? 3 : 2);
}

bool same_mode(const OniVideoMode& a, const OniVideoMode& b) {
    return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX &&
           a.resolutionY == b.resolutionY && a.fps == b.fps;
}

}  // namespace

SourceStream::SourceStream(const StreamDescription& description, std::function<void()> running_changed)
    : description_(description), running_changed_(std::move(running_changed)) {}

OniStatus SourceStream::start() {
    running_ = true;
    running_changed_();
    return ONI_STATUS_OK;
}

void SourceStream::stop() {
    running_ = false;
    running_changed_();
}

OniStatus SourceStream::getProperty(int id, void* data, int* size) {
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
            return give_property(OniBool{FALSE}, data, size);
        case ONI_STREAM_PROPERTY_CROPPING:  // the stock player shows nothing of a recording without this
                                            // property
            return give_property(OniCropping{FALSE, 0, 0, mode.resolutionX, mode.resolutionY}, data, size);
        case ONI_STREAM_PROPERTY_MAX_VALUE:
            if (description_.sensor == ONI_SENSOR_DEPTH) return give_property(max_depth_mm, data, size);
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
    if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
        const auto mode = take_property<OniVideoMode>(data, size);
        return mode && same_mode(*mode, description_.mode) ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
    }
    if (id == ONI_STREAM_PROPERTY_MIRRORING) {
        const auto mirrored = take_property<OniBool>(data, size);
        return mirrored && *mirrored == FALSE ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
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
        default:
            return FALSE;
    }
}

void SourceStream::notifyAllProperties() {
    raisePropertyChanged(ONI_STREAM_PROPERTY_HORIZONTAL_FOV, &description_.horizontal_fov_rad, sizeof(float));
    raisePropertyChanged(ONI_STREAM_PROPERTY_VERTICAL_FOV, &description_.vertical_fov_rad, sizeof(float));
    raisePropertyChanged(ONI_STREAM_PROPERTY_VIDEO_MODE, &description_.mode, sizeof(OniVideoMode));
}

void SourceStream::deliver(const void* pixels, std::size_t bytes, int index, std::uint64_t timestamp_us) {
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    const OniVideoMode& mode = description_.mode;
    const auto capacity =
        static_cast<std::size_t>(stride_bytes(mode)) * static_cast<std::size_t>(mode.resolutionY);
    const std::size_t size = std::min(bytes, capacity);
    if (size > 0) std::memcpy(frame->data, pixels, size);
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
