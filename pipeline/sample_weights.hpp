#pragma once

#include <cstdint>

#include "pipeline/maps.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct SampleWeightConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    int most = 8;                  ///< 1..255: weight of a surface at 1 m that faces the camera; 1: all alike
    float max_angle_deg = 80.0f;   ///< between normal and ray; surfaces seen flatter are left out
    float edge_gap_per_m = 0.03f;  ///< a pixel between neighbours so far before and behind it flies
};

/// How much each pixel of a frame counts in volumetric integration (PAPER.md#4): one uchar per pixel.
class SampleWeighting {
  public:
    SampleWeighting(const Device& device, const SampleWeightConfig& config, const Intrinsics& intrinsics);

    /// 0: left out (no depth, seen at a grazing angle, or flying at a depth edge); else 1 to `most`.
    /// Valid until the next call.
    const Buffer<std::uint8_t>& weigh(const LiveMaps& live);
    /// The same; pixels with a mask value other than 0 are left out, too.
    Buffer<std::uint8_t>& weigh(const LiveMaps& live, const Buffer<std::uint8_t>& mask);
    /// Weighs the pixels of the region; the others keep the weights of an earlier call.
    const Buffer<std::uint8_t>& weigh(const LiveMaps& live, const PixelRegion& region);

  private:
    void launch(const LaunchSize& size, const LiveMaps& live, const Buffer<std::uint8_t>& mask);

    Intrinsics intrinsics_;
    MapShape shape_;
    SampleWeightParams params_;
    Program program_;
    Kernel sample_weights_;
    Buffer<std::uint8_t> no_mask_, weights_;
};

/// Scalars of the weights as the kernel takes them.
SampleWeightParams make_sample_weight_params(const SampleWeightConfig& config);

}  // namespace touchstone
