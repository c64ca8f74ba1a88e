#pragma once

#include <cstdint>
#include <span>

#include "pipeline/maps.hpp"
#include "pipeline/pixel_region.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

/// Fig 11d, Listing 3: the surface of a volume as the camera would see it.
class Raycasting {
  public:
    Raycasting(const Device& device, const Intrinsics& intrinsics);

    /// The whole view.
    void raycast(const TsdfVolume& volume, const RigidTransform& T_g_c, SurfacePrediction& prediction);
    /// Only the tiles that hold pixels of the region; the rest of the prediction stays as it is.
    void raycast(const TsdfVolume& volume, const RigidTransform& T_g_c, const PixelRegion& region,
                 SurfacePrediction& prediction);
    /// Only the tiles that can see one of the changed bricks (table indices). With the pose of the last
    /// raycast the result is the same as raycast()'s; that is the cached background prediction of a fixed
    /// camera.
    void refresh(const TsdfVolume& volume, const RigidTransform& T_g_c, std::span<const int> changed_bricks,
                 SurfacePrediction& prediction);

    /// Only these tiles (row by row, tiles_per_row of the map's shape), each once.
    void raycast_tiles(const TsdfVolume& volume, const RigidTransform& T_g_c, std::span<const int> tiles,
                       SurfacePrediction& prediction);

  private:
    void update_ranges(const TsdfVolume& volume, const RigidTransform& T_g_c);
    void launch(const TsdfVolume& volume, const RigidTransform& T_g_c, int tiles,
                SurfacePrediction& prediction);

    const Device* device_;
    Intrinsics intrinsics_;
    MapShape shape_;
    Program selection_, raycast_;
    Kernel brick_range_image_, flag_brick_tiles_, raycast_kernel_;
    Buffer<int> tile_near_, tile_far_, tiles_, bricks_;
    Buffer<std::uint8_t> flags_;
};

}  // namespace touchstone
