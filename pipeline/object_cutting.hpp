#pragma once

#include "pipeline/depth_patch.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"
#include "pipeline/volume_snapshot.hpp"

namespace touchstone {

/// What appeared behind a part of the background: something stood there that is gone.
struct UncoveredSurface {
    DepthPatch mean;                   ///< of what is seen now, there and around it
    std::vector<std::uint8_t> inside;  ///< 1 where it lies behind the background

    bool is_inside(int x, int y) const { return mean.box.contains(x, y) && inside[mean.index(x, y)] != 0; }
    /// 255 in a map on it and some pixels around.
    void mark(std::vector<std::uint8_t>& map, const MapShape& shape) const;
};

/// Takes out of a volume the voxels of what stood before the uncovered surface: unknown from then on. Gives
/// them as a volume on the same grid; nothing else of the volume is changed. `frame.predicted_m` is the
/// background with the thing still in it. Waits for the device.
VolumeSnapshot cut_out(TsdfVolume& volume, const UncoveredSurface& uncovered, const ObjectFrame& frame,
                       const RigidTransform& T_g_c);

}  // namespace touchstone
