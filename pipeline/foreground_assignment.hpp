#pragma once

#include <span>
#include <vector>

#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/moving_volume.hpp"

namespace touchstone {

/// Points of one component, every `step_px` columns and rows.
ComponentPoints sample_component(const Foreground& foreground, const Buffer<float>& depth_m,
                                 const ForegroundComponent& component, const Intrinsics& intrinsics,
                                 int step_px);

/// Which of the components each volume holds: the index of its component, -1 where there is none. A component
/// goes to the volume whose prediction covers most of it, else to the nearest free one within `reach_m`.
std::vector<int> assign_components(std::span<const MovingVolume> volumes,
                                   std::span<const ComponentPoints> components, float reach_m);

}  // namespace touchstone
