#pragma once

#include <cstdint>

#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct DataAssociationConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    /// One step of disparity in 1/z, 1/m: 1/8 px over focal length times baseline of a Kinect v1.
    float disparity_step_per_m = 0.0029f;
    float sigmas_high = 4.0f;  ///< in front of the model: surely
    float sigmas_low = 1.5f;   ///< in front: where it is connected to a sure pixel
    /// Angle from which a pixel at the model's depth is marked as turned; 180: not compared (and faster).
    float max_normal_angle_deg = 180.0f;
};

AssociationParams make_association_params(const DataAssociationConfig& config);

/// Listing 1: one RejectionCode per live pixel against a prediction.
class DataAssociation {
  public:
    DataAssociation(const Device& device, const DataAssociationConfig& config, const Intrinsics& intrinsics);

    /// `T_p_c` takes points of the live camera to the camera of the prediction; with the identity no pixel is
    /// projected. `fallback_m` (a map of the prediction's pixels, metres, 0 = none) stands in where the
    /// prediction has no surface. `codes` is a map; pixels beyond the picture get ASSOCIATION_NO_LIVE_DEPTH.
    void associate(const LiveMaps& live, const SurfacePrediction& model, const Buffer<float>& fallback_m,
                   const RigidTransform& T_p_c, Buffer<std::uint8_t>& codes);

  private:
    Intrinsics intrinsics_;
    MapShape shape_;
    AssociationParams params_;
    Program program_;
    Kernel associate_;
};

}  // namespace touchstone
