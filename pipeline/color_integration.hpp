#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/maps.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct ColorIntegrationConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float band_vox = 1.5f;                               ///< how far from the surface voxels have colours
    float max_angle_deg = 60.0f;                         ///< between normal and ray
    int guard_px = 3;                                    ///< pixels so near to a depth edge give no colour
    float edge_gap_per_m = 0.015f;  ///< what makes an edge, over what a surface at the largest angle does
};

/// Colour of the surface from a colour picture that is registered to the depth picture (Fig 1C, 6A).
class ColorIntegration {
  public:
    ColorIntegration(const Device& device, const ColorIntegrationConfig& config,
                     const Intrinsics& intrinsics);

    /// To be called after VolumetricIntegration with the maps, the sample weights and the pose it took, and
    /// the bricks it gave. `rgb`: 3 bytes a pixel, row-major, the size of the depth picture. The volume
    /// keeps colours from the first call on. Throws Error{bad_data} where the picture has another size.
    void integrate(TsdfVolume& volume, const LiveMaps& live, std::span<const std::uint8_t> rgb,
                   const Buffer<std::uint8_t>& sample_weights, const RigidTransform& T_g_c,
                   std::span<const int> bricks);

  private:
    /// Brick, slot and colour slot of each of the bricks that holds a surface; gives colours to those that
    /// have none.
    std::size_t place_bricks(TsdfVolume& volume, std::span<const int> bricks);

    const Device* device_;
    Intrinsics intrinsics_;
    MapShape shape_;
    ColorParams params_;
    Program program_;
    Kernel color_weights_, find_surface_bricks_, integrate_colors_;
    Buffer<std::uint8_t> weights_, rgb_, flags_;
    Buffer<int> slots_, places_;
};

}  // namespace touchstone
