#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// `touchstone track`: follows the camera against the growing model, until the source or the wanted frames
/// are at their end or a signal asks to end. Throws Error.
ExitStatus track_command(const TrackOptions& options);

}  // namespace touchstone
