#include "app/configured_camera.hpp"

#include <fmt/format.h>

#include "platform/system/error.hpp"

namespace touchstone {

DepthCamera configured_camera(const Config& config, std::optional<Pace> pace, bool with_color) {
    try {
        return DepthCamera::open(config.sensor_uri, pace, with_color, camera_setup(config));
    } catch (const Error& error) {
        if (config.sensor_named_in.empty()) throw;
        throw Error(error.status() == ExitStatus::usage ? ExitStatus::configuration : error.status(),
                    fmt::format("{}: sensor.uri: {}", config.sensor_named_in, error.what()));
    }
}

}  // namespace touchstone
