#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/background_model.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/still_components.hpp"
#include "pipeline/touch_event.hpp"
#include "pipeline/uncovered_surfaces.hpp"

namespace touchstone {

/// What happened to things in one frame.
struct ObjectChanges {
    int settled = 0;                     ///< put down: background from now on
    int taken = 0;                       ///< that had been put down and are gone
    std::vector<VolumeSnapshot> lifted;  ///< out of the scan: their voxels, on the background's grid
};

/// Fig 5: objects by moving them. What is put down becomes background that can be touched, what is taken away
/// again leaves what was there before, and what is lifted out of the scan becomes a model of its own.
class ObjectSegmentation {
  public:
    ObjectSegmentation(const ObjectsConfig& config, const Intrinsics& intrinsics)
        : config_(config),
          intrinsics_(intrinsics),
          still_(config, intrinsics),
          uncovered_(config, intrinsics) {}

    /// `foreground`: of this frame against the background's prediction, which may change.
    ObjectChanges update(const LiveMaps& live, const Foreground& foreground,
                         std::span<const TouchEvent> touches, std::uint64_t timestamp_us,
                         BackgroundModel& background);
    /// The camera is elsewhere, or the background another.
    void forget();

  private:
    struct Found {
        std::vector<DepthPatch> settled;
        std::vector<UncoveredSurface> lifted;
    };

    Found look(const ObjectFrame& frame, bool uncovered);
    void export_object(const VolumeSnapshot& object, const RigidTransform& T_g_c);

    ObjectsConfig config_;
    Intrinsics intrinsics_;
    StillComponents still_;
    UncoveredSurfaces uncovered_;
    bool waited_ = false;  ///< something was left out of the background in the last frame
    int exported_ = 0;
};

}  // namespace touchstone
