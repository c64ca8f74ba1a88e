#pragma once

#include "app/command_line.hpp"
#include "pipeline/reconstruction.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// What a moving camera shares with the table, and its own volume.
ReconstructionConfig reconstruction_config(const InteractionConfig& interaction, int voxels, float side_m);

/// `touchstone track`: follows the camera against the growing model, until the source or the wanted frames
/// are at their end or a signal asks to end. Throws Error.
ExitStatus track_command(const TrackOptions& options);

}  // namespace touchstone
