#include "pipeline/sample_weights.hpp"

#include <cmath>
#include <numbers>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

SampleWeightParams make_sample_weight_params(const SampleWeightConfig& config) {
    SampleWeightParams params{};
    const float from_offset_m = 1.0f - config.noise.offset_m;
    params.noise = config.noise;
    params.reference_sigma_m =
        config.noise.constant_m + config.noise.quadratic * from_offset_m * from_offset_m;
    params.min_cos = std::cos(config.max_angle_deg * std::numbers::pi_v<float> / 180.0f);
    params.gap_per_m = config.edge_gap_per_m;
    params.most = config.most;
    return params;
}

SampleWeighting::SampleWeighting(const Device& device, const SampleWeightConfig& config,
                                 const Intrinsics& intrinsics)
    : intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      params_(make_sample_weight_params(config)),
      program_(load_kernel_program(device, "sample_weights.cl")),
      sample_weights_(program_.kernel("sample_weights")),
      no_mask_(device, map_pixels(shape_)),
      weights_(device, map_pixels(shape_)) {
    if (config.most < 1 || config.most > 255)
        throw Error(ExitStatus::configuration, "the largest sample weight must be from 1 to 255");
    no_mask_.fill(0);
}

const Buffer<std::uint8_t>& SampleWeighting::weigh(const LiveMaps& live) { return weigh(live, no_mask_); }

Buffer<std::uint8_t>& SampleWeighting::weigh(const LiveMaps& live, const Buffer<std::uint8_t>& mask) {
    launch(eight_pixels_each(shape_), live, mask);
    return weights_;
}

const Buffer<std::uint8_t>& SampleWeighting::weigh(const LiveMaps& live, const PixelRegion& region) {
    launch(eight_pixels_each(shape_, region), live, no_mask_);
    return weights_;
}

void SampleWeighting::launch(const LaunchSize& size, const LiveMaps& live, const Buffer<std::uint8_t>& mask) {
    sample_weights_.launch(size, live.depth_m, live.normals_c, mask, weights_, shape_, intrinsics_, params_);
}

}  // namespace touchstone
