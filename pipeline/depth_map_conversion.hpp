#pragma once

#include <cstdint>
#include <span>

#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct DepthMapConversionConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float min_depth_m = 0.3f;
    float max_depth_m = 6.0f;
    float filter_sigma_px = 1.5f;
    float filter_range_sigmas = 2.0f;
    float normal_gap_per_m =
        0.03f;  ///< neighbours farther apart in depth than this times the depth are not joined
};

/// Fig 11a: depth picture -> metric depth, filtered depth, normals.
class DepthMapConversion {
  public:
    DepthMapConversion(const Device& device, const DepthMapConversionConfig& config,
                       const Intrinsics& intrinsics);

    /// `view` must have the size of the intrinsics given at construction.
    void convert(const DepthView& view, LiveMaps& live);
    /// The same in two steps: both depths, and the normals where they can wait.
    void convert_depth(const DepthView& view, LiveMaps& live);
    void find_normals(LiveMaps& live);
    /// What is added to 1/z of each column from the next frame on, in 1/m: width_px values (slow drift of the
    /// sensor).
    void set_column_shift(std::span<const float> shift_per_m);

  private:
    DepthMapConversionConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    FilterParams params_;
    Program program_;
    Kernel convert_depth_, bilateral_filter_, normal_map_;
    Buffer<std::uint16_t> depth_mm_;
    Buffer<float> column_shift_;
};

}  // namespace touchstone
