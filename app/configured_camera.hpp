#pragma once

#include <optional>

#include "app/config.hpp"
#include "platform/camera/depth_camera.hpp"

namespace touchstone {

/// The camera of the configuration, else the attached one. Throws as DepthCamera::open() does, with file and
/// line of a URI that stands in a configuration file; one that is no URI is Error{configuration} then.
DepthCamera configured_camera(const Config& config, std::optional<Pace> pace, bool with_color);

}  // namespace touchstone
