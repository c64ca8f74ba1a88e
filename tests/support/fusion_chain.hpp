#pragma once

#include <vector>

#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/sample_weights.hpp"
#include "pipeline/volumetric_integration.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone::test {

/// Fig 11 without tracking: pictures at known poses become one volume, seen again by raycast.
class FusionChain {
  public:
    FusionChain(const Intrinsics& intrinsics, const VolumeConfig& volume_config,
                const SampleWeightConfig& weights = {})
        : k(intrinsics),
          volume(device, volume_config),
          conversion_(device, {}, k),
          weighting_(device, weights, k),
          integration_(device, k),
          raycasting_(device, k),
          live(device, make_map_shape(k)),
          prediction(device, make_map_shape(k)) {}

    void fuse(const std::vector<std::uint16_t>& depth_mm, const RigidTransform& T_g_c) {
        conversion_.convert({depth_mm, k}, live);
        integration_.integrate(volume, live.depth_m, weighting_.weigh(live), T_g_c, all_layers(volume));
    }
    /// width x height depths in metres, 0 where no surface is seen.
    std::vector<float> seen_m(const RigidTransform& T_g_c) {
        raycasting_.raycast(volume, T_g_c, prediction);
        return cropped(prediction.shape, prediction.depth_m.read());
    }
    Eigen::Vector3f normal_c(int x, int y) const {
        const std::vector<float> normals = prediction.normals_c.read();
        const std::size_t at = map_index(prediction.shape, x, y), plane = map_pixels(prediction.shape);
        return {normals[at], normals[plane + at], normals[2 * plane + at]};
    }

    Device device{DeviceConfig{}};
    Intrinsics k;
    TsdfVolume volume;

  private:
    DepthMapConversion conversion_;
    SampleWeighting weighting_;
    VolumetricIntegration integration_;
    Raycasting raycasting_;

  public:
    LiveMaps live;
    SurfacePrediction prediction;
};

}  // namespace touchstone::test
