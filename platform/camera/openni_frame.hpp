#pragma once

#include <OpenNI.h>

#include "platform/camera/depth_frame.hpp"
#include "platform/camera/frame_pairing.hpp"

namespace touchstone {

/// Throws Error{bad_data} for a format other than millimetres or tenths of them, or a frame shorter than its
/// size.
DepthFrame to_depth_frame(const openni::VideoFrameRef& frame, const Intrinsics& intrinsics);

/// RGB888 or GRAY8; Error{bad_data} for others. An empty frame gives a picture without pixels.
ColorPicture to_color_picture(const openni::VideoFrameRef& frame);

/// Intrinsics of a depth stream from its fields of view, the principal point in the middle; the Kinect's
/// nominal ones where the driver or the recording gives no fields of view.
Intrinsics intrinsics_from_fov(const openni::VideoStream& stream);

/// Chooses on a real device 640x480 at 30 Hz, else its largest mode, among the formats we read. Throws
/// Error{unavailable} where it has none.
void choose_depth_mode(openni::VideoStream& stream);
void choose_color_mode(openni::VideoStream& stream);

}  // namespace touchstone
