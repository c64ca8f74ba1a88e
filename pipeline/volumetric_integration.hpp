#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/maps.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

/// Brick layers of the volume along global y, each `step`th from the first on.
struct BrickLayers {
    int first = 0;
    int count = 0;
    int step = 1;
};
/// All layers of a volume.
BrickLayers all_layers(const TsdfVolume& volume);
/// Part `index` of `parts` about equal slices: a fixed camera's background is kept up in them.
BrickLayers layer_share(const TsdfVolume& volume, int index, int parts);
/// Every `parts`th layer from layer `index` on: each part is seen as much as the others.
BrickLayers interleaved_layers(const TsdfVolume& volume, int index, int parts);

/// Fig 11c, Listing 2: fuses a weighted depth picture into a volume, touching only bricks near or in front of
/// the surface.
class VolumetricIntegration {
  public:
    /// `noise`: how far behind a surface a sample still measures; the default is a Kinect v1's.
    VolumetricIntegration(const Device& device, const Intrinsics& intrinsics,
                          const SensorNoise& noise = {0.0012f, 0.0019f, 0.4f, 0.0001f});

    /// Allocates the bricks near the surface in these layers and updates them and those in free space.
    /// `sample_weights` is SampleWeighting's; pixels of weight 0 are left out and allocate nothing. Gives the
    /// table indices of the bricks it updated.
    const std::vector<int>& integrate(TsdfVolume& volume, const Buffer<float>& depth_m,
                                      const Buffer<std::uint8_t>& sample_weights, const RigidTransform& T_g_c,
                                      const BrickLayers& layers);

    /// Listing 2 with the adaptive weight, into a volume that moves with what it holds: allocates the bricks
    /// near the surface, of pixels with a weight in `surface_weights`, and updates every brick in use with
    /// the pixels of `sample_weights` (0, 1 to 254, or SAMPLE_FREE_ONLY).
    void integrate_moving(TsdfVolume& volume, const Buffer<float>& depth_m,
                          const Buffer<std::uint8_t>& surface_weights,
                          const Buffer<std::uint8_t>& sample_weights, const RigidTransform& T_g_c,
                          const BrickLayers& layers, const AdaptiveWeightParams& adaptive);

  private:
    void classify(const TsdfVolume& volume, const Buffer<float>& depth_m,
                  const Buffer<std::uint8_t>& sample_weights, const Pose& T_c_g, const BrickLayers& layers);
    void select_bricks(TsdfVolume& volume, const BrickLayers& layers);

    const Device* device_;
    Intrinsics intrinsics_;
    SensorNoise noise_;
    MapShape shape_;
    Program selection_, integration_;
    Kernel depth_tile_ranges_, classify_bricks_, integrate_, integrate_moving_;
    Buffer<float> tile_ranges_m_;  // nearest and farthest of each tile
    Buffer<std::uint8_t> classes_;
    Buffer<int> slots_;
    std::vector<int> updated_bricks_;
};

}  // namespace touchstone
