#include "pipeline/data_association.hpp"

#include <cmath>
#include <numbers>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

AssociationParams make_association_params(const DataAssociationConfig& config) {
    const float uniform_sigma = 1.0f / std::sqrt(12.0f);
    const float radians = config.max_normal_angle_deg * std::numbers::pi_v<float> / 180.0f;
    return {config.noise, config.disparity_step_per_m * uniform_sigma, config.sigmas_high, config.sigmas_low,
            config.max_normal_angle_deg >= 180.0f ? -1.0f : std::cos(radians)};
}

DataAssociation::DataAssociation(const Device& device, const DataAssociationConfig& config,
                                 const Intrinsics& intrinsics)
    : intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      params_(make_association_params(config)),
      program_(load_kernel_program(device, "listing_1_data_association.cl")),
      associate_(program_.kernel("associate")) {}

void DataAssociation::associate(const LiveMaps& live, const SurfacePrediction& model,
                                const Buffer<float>& fallback_m, const RigidTransform& T_p_c,
                                Buffer<std::uint8_t>& codes) {
    const int aligned = T_p_c.matrix().isIdentity(0.0f) ? 1 : 0;
    associate_.launch(eight_pixels_each(shape_), live.filtered_m, live.normals_c, model.depth_m,
                      model.normals_c, fallback_m, codes, shape_, intrinsics_, to_pose(T_p_c), aligned,
                      params_);
}

}  // namespace touchstone
