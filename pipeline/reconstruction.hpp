#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pipeline/camera_tracking.hpp"
#include "pipeline/color_integration.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/keyframes.hpp"
#include "pipeline/moving_parts.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/relocalisation.hpp"
#include "pipeline/sample_weights.hpp"
#include "pipeline/step_filter.hpp"
#include "pipeline/volumetric_integration.hpp"
#include "platform/system/stage_timer.hpp"

namespace touchstone {

/// A smaller cube is for an object that is turned by hand.
inline constexpr float object_side_m = 1.5f;

struct ReconstructionConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< of every stage
    DepthMapConversionConfig conversion;
    CameraTrackingConfig tracking;
    StepFilterConfig steps;
    VolumeConfig volume;
    SampleWeightConfig weights;
    ColorIntegrationConfig color;
    MovingPartsConfig moving;
    /// Tracks again, with care and without what moves, where so much of the picture does, or so little fits.
    float track_again_share = 0.003f, track_again_inlier_share = 0.0f;
    float poor_moving_share = 0.5f;  ///< of the picture: not fused
    int proving_frames = 5;          ///< that a pose found again must be tracked well before it is fused
    int frames_per_sweep = 2;        ///< in which all of a model that is not young is fused once
    /// The surface is predicted anew, and the view looked at as a keyframe, every so many frames, while the
    /// model is young, and where the camera has moved by more since.
    int frames_per_prediction = 3, young_model_frames = 30;
    float max_prediction_shift_m = 0.05f, max_prediction_turn_deg = 4.0f;
    bool use_color = true;  ///< brightness helps to track, where there is a colour picture
};

/// What one frame gave.
struct ReconstructionFrame {
    TrackingResult tracking;  ///< good without figures at the first frame
    RigidTransform T_g_c = RigidTransform::Identity();
    bool fused = false;
    float moving_share = 0.0f;  ///< of the picture, that moves apart from the model
};

/// Where a cube of this side lies for a camera that is at its first frame: for a room, the camera starts near
/// the middle of the front face; a cube of less than 1.5 m lies around the thing in the middle of the view
/// (an object that is turned by hand). Nothing while the view shows nothing.
std::optional<RigidTransform> place_camera(const DepthView& view, float side_m);

/// Figures 2 and 11 for a moving camera: track against the growing model, fuse, predict. A camera that is
/// lost is looked for around its last pose, then at the keyframes; the model is never wiped.
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
    /// Map of the last frame: 255 where something moves apart from the model, widened, else 0.
    const Buffer<std::uint8_t>& moving_mask() const { return moving_.mask(); }
    const RigidTransform& T_g_c() const { return T_g_c_; }
    const KeyframeDatabase& keyframes() const { return keyframes_; }
    /// Stages by the paper's names, and "frame" for all of process().
    const StageTimes& stage_times() const { return times_; }

  private:
    void track(bool has_intensity, ReconstructionFrame& frame);
    TrackingResult align(CameraTracking& tracking, bool has_intensity,
                         std::span<const RigidTransform> guesses);
    void find_moving(ReconstructionFrame& frame);
    void align_again(bool has_intensity, TrackingResult& found);
    void relocalise(const DepthView& view, ReconstructionFrame& frame);
    void mark_outside(const RigidTransform& T_g_c);
    BrickLayers layers_to_fuse() const;
    void fuse(std::span<const std::uint8_t> color_rgb);
    RigidTransform T_p_l() const;  // of the last frame that was tracked, seen from the prediction
    bool needs_prediction(const ReconstructionFrame& frame);
    void predict(bool has_intensity);

    const Device* device_;
    ReconstructionConfig config_;
    Intrinsics intrinsics_;
    StageTimes times_;
    DepthMapConversion conversion_;
    CameraTracking tracking_, careful_tracking_;
    MovingParts moving_;
    TsdfVolume volume_;
    SampleWeighting weighting_;
    VolumetricIntegration integration_;
    std::optional<ColorIntegration> color_;
    Raycasting raycasting_;
    Program bounds_program_;
    Kernel mark_outside_;
    Buffer<std::uint8_t> outside_;  // live pixels that are not of the volume, or move
    KeyframeDatabase keyframes_;
    std::optional<Relocalisation> relocalisation_;  // from the first loss on
    int frames_to_prove_ = 0;                       // after a loss, tracked but not fused
    LiveMaps live_;
    SurfacePrediction prediction_;
    IntensityMaps live_intensity_, model_intensity_;
    bool model_has_intensity_ = false;
    RigidTransform T_g_c_;  // of the last frame that was tracked
    RigidTransform T_g_p_;  // of the prediction
    int frames_on_prediction_ = 0;
    RigidTransform velocity_;  // the last step: from the frame before the last one
    StepFilter steps_;
    int fused_frames_ = 0;
};

}  // namespace touchstone
