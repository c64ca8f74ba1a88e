#pragma once

#include <OpenNI.h>
#include <optional>
#include <span>

#include "platform/camera/depth_frame.hpp"
#include "platform/camera/frame_pairing.hpp"
#include "platform/camera/sensor_models.hpp"

namespace touchstone {

/// Throws Error{bad_data} for a format other than millimetres or tenths of them, or a frame shorter than its
/// size.
DepthFrame to_depth_frame(const openni::VideoFrameRef& frame, const Intrinsics& intrinsics);

/// RGB888 or GRAY8; Error{bad_data} for others. An empty frame gives a picture without pixels.
ColorPicture to_color_picture(const openni::VideoFrameRef& frame);

/// Intrinsics of a depth stream from its fields of view, the principal point in the middle; the Kinect's
/// nominal ones where the driver or the recording gives no fields of view.
Intrinsics intrinsics_from_fov(const openni::VideoStream& stream);

/// The one of a camera's modes that is nearest to what is wished: first the size, else the largest; then the
/// rate. Nothing where there is none.
std::optional<std::size_t> nearest_mode(std::span<const DepthMode> modes, const DepthMode& wish);

/// Chooses on a real device the mode nearest to the wish among the formats we read. Throws Error{unavailable}
/// where it has none, or where it `must` be the one and is not there.
void choose_depth_mode(openni::VideoStream& stream, const DepthMode& wish, bool must);
void choose_color_mode(openni::VideoStream& stream);

}  // namespace touchstone
