#include "platform/camera/openni_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fmt/core.h>
#include <initializer_list>
#include <tuple>

#include "platform/camera/openni_error.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr float kinect_focal_px = 575.8F, kinect_width_px = 640.0F;

bool is_one_of(openni::PixelFormat format, std::initializer_list<openni::PixelFormat> formats) {
    for (const auto candidate : formats) {
        if (format == candidate) return true;
    }
    return false;
}

/// Bytes of one row; checks that the frame holds all of them.
std::size_t checked_row_bytes(const openni::VideoFrameRef& frame, std::size_t pixel_bytes, const char* what) {
    const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(frame.getWidth());
    const auto stride = static_cast<std::size_t>(frame.getStrideInBytes());
    const auto height = static_cast<std::size_t>(frame.getHeight());
    const auto size = static_cast<std::size_t>(frame.getDataSize());
    if (height == 0 || row_bytes == 0 || stride < row_bytes || size < stride * (height - 1) + row_bytes) {
        throw Error(ExitStatus::bad_data,
                    fmt::format("the camera delivered a {} frame of {} bytes for {}x{} pixels", what, size,
                                frame.getWidth(), height));
    }
    return row_bytes;
}

template <class Pixel>
std::vector<Pixel> copy_rows(const openni::VideoFrameRef& frame, std::size_t row_bytes) {
    const auto height = static_cast<std::size_t>(frame.getHeight());
    const auto stride = static_cast<std::size_t>(frame.getStrideInBytes());
    std::vector<Pixel> pixels(row_bytes / sizeof(Pixel) * height);
    const auto* from = static_cast<const std::uint8_t*>(frame.getData());
    auto* to = reinterpret_cast<std::uint8_t*>(pixels.data());
    for (std::size_t y = 0; y < height; ++y) std::memcpy(to + y * row_bytes, from + y * stride, row_bytes);
    return pixels;
}

struct OfferedModes {
    std::vector<const openni::VideoMode*> openni;
    std::vector<DepthMode> modes;
};

OfferedModes offered_modes(openni::VideoStream& stream, std::initializer_list<openni::PixelFormat> formats) {
    OfferedModes offered;
    const auto& all = stream.getSensorInfo().getSupportedVideoModes();
    for (int i = 0; i < all.getSize(); ++i) {
        if (!is_one_of(all[i].getPixelFormat(), formats)) continue;
        offered.openni.push_back(&all[i]);
        offered.modes.push_back({all[i].getResolutionX(), all[i].getResolutionY(), all[i].getFps()});
    }
    return offered;
}

std::string list_of(const std::vector<DepthMode>& modes) {
    std::string list;
    for (const DepthMode& mode : modes) {
        const std::string text = to_text(mode);
        if (list.find(text) == std::string::npos) list += (list.empty() ? "" : ", ") + text;
    }
    return list;
}

void choose_mode(openni::VideoStream& stream, std::initializer_list<openni::PixelFormat> formats,
                 const char* what, const DepthMode& wish, bool must) {
    const OfferedModes offered = offered_modes(stream, formats);
    const std::optional<std::size_t> best = nearest_mode(offered.modes, wish);
    if (!best) {
        throw Error(ExitStatus::unavailable,
                    fmt::format("the camera has no {} pictures that Touchstone reads", what));
    }
    if (must && offered.modes[*best] != wish) {
        throw Error(ExitStatus::unavailable,
                    fmt::format("the camera has no {} pictures of sensor.mode {}; it has {}", what,
                                to_text(wish), list_of(offered.modes)));
    }
    if (stream.setVideoMode(*offered.openni[*best]) != openni::STATUS_OK) {
        throw Error(ExitStatus::unavailable,
                    fmt::format("the camera refuses {} {} pictures: {}", to_text(offered.modes[*best]), what,
                                one_line(openni::OpenNI::getExtendedError())));
    }
}

}  // namespace

DepthFrame to_depth_frame(const openni::VideoFrameRef& frame, const Intrinsics& intrinsics) {
    const auto format = frame.getVideoMode().getPixelFormat();
    if (!is_one_of(format, {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM})) {
        throw Error(
            ExitStatus::bad_data,
            fmt::format("the camera's depth is in OpenNI format {}: only millimetres (100) and tenths of "
                        "them (101) are read",
                        static_cast<int>(format)));
    }
    DepthFrame result;
    result.index = frame.getFrameIndex();
    result.timestamp_us = frame.getTimestamp();
    result.width_px = frame.getWidth();
    result.height_px = frame.getHeight();
    result.intrinsics = intrinsics;
    result.depth_mm = copy_rows<std::uint16_t>(frame, checked_row_bytes(frame, 2, "depth"));
    if (format == openni::PIXEL_FORMAT_DEPTH_100_UM) {
        for (auto& depth : result.depth_mm) depth = static_cast<std::uint16_t>((depth + 5) / 10);
    }
    return result;
}

ColorPicture to_color_picture(const openni::VideoFrameRef& frame) {
    ColorPicture picture{frame.getTimestamp(), frame.getWidth(), frame.getHeight(), {}};
    if (frame.getDataSize() == 0) return picture;
    const auto format = frame.getVideoMode().getPixelFormat();
    if (format == openni::PIXEL_FORMAT_RGB888) {
        picture.rgb = copy_rows<std::uint8_t>(frame, checked_row_bytes(frame, 3, "colour"));
    } else if (format == openni::PIXEL_FORMAT_GRAY8) {
        const auto gray = copy_rows<std::uint8_t>(frame, checked_row_bytes(frame, 1, "colour"));
        picture.rgb.reserve(3 * gray.size());
        for (const auto value : gray) picture.rgb.insert(picture.rgb.end(), 3, value);
    } else {
        throw Error(
            ExitStatus::bad_data,
            fmt::format(
                "the camera's colour is in OpenNI format {}: only RGB888 (200) and GRAY8 (202) are read",
                static_cast<int>(format)));
    }
    return picture;
}

Intrinsics intrinsics_from_fov(const openni::VideoStream& stream) {
    const openni::VideoMode mode = stream.getVideoMode();
    const auto width = static_cast<float>(mode.getResolutionX()),
               height = static_cast<float>(mode.getResolutionY());
    float horizontal_rad = 0, vertical_rad = 0;
    stream.getProperty(openni::STREAM_PROPERTY_HORIZONTAL_FOV, &horizontal_rad);
    stream.getProperty(openni::STREAM_PROPERTY_VERTICAL_FOV, &vertical_rad);
    const float nominal_px = kinect_focal_px * width / kinect_width_px;
    const bool known = horizontal_rad > 0 && vertical_rad > 0;
    const float fx_px = known ? width / (2 * std::tan(horizontal_rad / 2)) : nominal_px;
    const float fy_px = known ? height / (2 * std::tan(vertical_rad / 2)) : nominal_px;
    return {fx_px, fy_px, (width - 1) / 2, (height - 1) / 2, mode.getResolutionX(), mode.getResolutionY(),
            {}};
}

std::optional<std::size_t> nearest_mode(std::span<const DepthMode> modes, const DepthMode& wish) {
    const auto is_worse = [&](const DepthMode& a, const DepthMode& b) {
        const auto key = [&](const DepthMode& mode) {
            const bool same_size = mode.width_px == wish.width_px && mode.height_px == wish.height_px;
            return std::tuple(same_size, same_size ? 0 : mode.width_px * mode.height_px,
                              -std::abs(mode.rate_hz - wish.rate_hz));
        };
        return key(a) < key(b);
    };
    const auto best = std::ranges::max_element(modes, is_worse);
    if (best == modes.end()) return std::nullopt;
    return static_cast<std::size_t>(best - modes.begin());
}

void choose_depth_mode(openni::VideoStream& stream, const DepthMode& wish, bool must) {
    choose_mode(stream, {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM}, "depth", wish,
                must);
}

void choose_color_mode(openni::VideoStream& stream) {
    choose_mode(stream, {openni::PIXEL_FORMAT_RGB888, openni::PIXEL_FORMAT_GRAY8}, "colour", {}, false);
}

}  // namespace touchstone
