#include "app/track_command.hpp"

namespace touchstone {

ExitStatus track_command(const TrackOptions& options) {
    throw Error(
        ExitStatus::unavailable,
        options.config.sensor_uri + " is not tracked: track is not in this version; take a newer one");
}

}  // namespace touchstone
