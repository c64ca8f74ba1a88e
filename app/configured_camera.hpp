#pragma once

#include <optional>

#include "app/config.hpp"
#include "platform/camera/depth_camera.hpp"

namespace touchstone {

/// The camera of the configuration, else the attached one. Throws as DepthCamera::open() does; a URI that is
/// none and stands in a configuration file is Error{configuration} that names the file.
DepthCamera configured_camera(const Config& config, std::optional<Pace> pace, bool with_color);

}  // namespace touchstone
