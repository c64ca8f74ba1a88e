#pragma once

#include <optional>

#include "platform/camera/depth_camera.hpp"
#include "platform/system/termination_signals.hpp"

namespace touchstone {

/// The next frame, waited for. Nothing once the source is at its end or a signal asks to end. Throws
/// Error{unavailable} where the camera is gone or gives nothing for 10 s, else as DepthCamera::read.
std::optional<DepthFrame> read_frame(DepthCamera& camera, TerminationSignals& signals);

}  // namespace touchstone
