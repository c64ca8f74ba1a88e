#pragma once

#include "app/command_line.hpp"
#include "pipeline/reconstruction.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// The model of what a moving camera sees, begun with its first view; nothing where that shows too little.
std::optional<Reconstruction> begin_reconstruction(const Device& device, const InteractionConfig& interaction,
                                                   const DepthView& view, int voxels, float side_m);

/// `touchstone track`: follows the camera against the growing model, until the source or the wanted frames
/// are at their end or a signal asks to end. Throws Error.
ExitStatus track_command(const TrackOptions& options);

}  // namespace touchstone
