#pragma once

#include <numbers>

#include "pipeline/camera_tracking.hpp"
#include "tests/reference/listing_1_camera_tracking.hpp"
#include "tests/support/oriented_scene.hpp"

namespace touchstone::test {

/// As the tracking has them at a level.
inline AlignmentParams alignment_params(const CameraTrackingConfig& config, int level,
                                        const Eigen::Vector3f& centre) {
    const TrackingLevel& limits = config.levels[static_cast<std::size_t>(level)];
    AlignmentParams params{};
    params.noise = config.noise;
    params.centre_p = {centre.x(), centre.y(), centre.z(), 0.0f};
    params.max_distance_m = limits.max_distance_m;
    params.min_normal_cos = std::cos(config.max_normal_angle_deg * std::numbers::pi_v<float> / 180.0f);
    params.huber_sigmas = config.huber_sigmas;
    params.cutoff_sigmas = limits.cutoff_sigmas;
    params.reference_sigma_m = static_cast<float>(reference::sigma_m(config.noise, 1.0, 1.0));
    params.intensity_sigma = config.intensity_sigma;
    return params;
}

/// Sums of the kernels for two pictures of one camera.
class AlignmentOfTwo {
  public:
    AlignmentOfTwo(const Intrinsics& k, const reference::OrientedPicture& live,
                   const reference::OrientedPicture& model, const CameraTrackingConfig& config = {})
        : middle(reference::middle_of(live, k, 2, config.half_sample_gap_per_m)),
          tracking(device, config, k),
          live_(device, make_map_shape(k)),
          prediction(device, live_.shape) {
        write_live(live, live_);
        write_model(model, prediction);
        tracking.prepare(live_);
    }
    AlignmentSums at(const RigidTransform& T_p_c, int level) {
        return tracking.sum(prediction, T_p_c, level);
    }

    const Eigen::Vector3f middle;  ///< about which twists turn

    const Device device{DeviceConfig{}};
    CameraTracking tracking;

  private:
    LiveMaps live_;

  public:
    SurfacePrediction prediction;
};

}  // namespace touchstone::test
