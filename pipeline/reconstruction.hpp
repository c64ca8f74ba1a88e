#pragma once

#include <cstdint>
#include <span>

#include "pipeline/camera_tracking.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/sample_weights.hpp"
#include "pipeline/volumetric_integration.hpp"
#include "platform/system/stage_timer.hpp"

namespace touchstone {

struct ReconstructionConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< of every stage
    DepthMapConversionConfig conversion;
    CameraTrackingConfig tracking;
    VolumeConfig volume;
    SampleWeightConfig weights;
    bool use_color = true;  ///< brightness helps to track, where there is a colour picture
};

/// What one frame gave.
struct ReconstructionFrame {
    TrackingResult tracking;  ///< good without figures at the first frame
    RigidTransform T_g_c = RigidTransform::Identity();
    bool fused = false;
};

/// Figures 2 and 11 for a moving camera: track against the growing model, fuse, predict.
class Reconstruction {
  public:
    /// `T_g_c` is the camera's pose at the first frame.
    Reconstruction(const Device& device, const ReconstructionConfig& config, const Intrinsics& intrinsics,
                   const RigidTransform& T_g_c);

    /// `color_rgb`: empty, or 3 bytes a pixel, registered to the depth picture.
    ReconstructionFrame process(const DepthView& view, std::span<const std::uint8_t> color_rgb = {});

    const TsdfVolume& volume() const { return volume_; }
    const SurfacePrediction& prediction() const { return prediction_; }
    const LiveMaps& live() const { return live_; }
    const RigidTransform& T_g_c() const { return T_g_c_; }
    /// Stages by the paper's names, and "frame" for all of process().
    const StageTimes& stage_times() const { return times_; }

  private:
    void track(bool has_intensity, ReconstructionFrame& frame);
    void fuse();

    const Device* device_;
    ReconstructionConfig config_;
    StageTimes times_;
    DepthMapConversion conversion_;
    CameraTracking tracking_;
    TsdfVolume volume_;
    SampleWeighting weighting_;
    VolumetricIntegration integration_;
    Raycasting raycasting_;
    LiveMaps live_;
    SurfacePrediction prediction_;
    IntensityMaps live_intensity_, model_intensity_;
    bool model_has_intensity_ = false;
    RigidTransform T_g_c_;     // of the last frame that was tracked
    RigidTransform T_g_p_;     // of the prediction
    RigidTransform velocity_;  // T_p_c of the last step
    bool empty_ = true;
};

}  // namespace touchstone
