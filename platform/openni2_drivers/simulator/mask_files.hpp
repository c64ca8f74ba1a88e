#pragma once

#include <filesystem>

#include "platform/openni2_drivers/common/frame_source.hpp"
#include "platform/openni2_drivers/simulator/hand_layer.hpp"

namespace touchstone::sim {

/// Writes the frame's depth and the true mask of the hands, 255 = hand: frame-NNNNNN.depth.png and
/// truth-NNNNNN.mask.png. Throws Error{io_error}.
void write_masks(const std::filesystem::path& folder, const SourceFrame& frame, const Picture& picture,
                 const Intrinsics& intrinsics);

}  // namespace touchstone::sim
