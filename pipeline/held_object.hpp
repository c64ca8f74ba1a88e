#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/camera_tracking.hpp"
#include "pipeline/maps.hpp"
#include "pipeline/model_agreement.hpp"
#include "pipeline/object_templates.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/volume_snapshot.hpp"

namespace touchstone {

/// Searching: never seen yet. Lost: it was tracked, and is searched for. Both say why.
enum class HeldObjectState { searching, tracked, lost };

struct HeldObjectConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< of every part
    ObjectTemplatesConfig templates;
    ModelAgreementConfig agreement;
    CameraTrackingConfig tracking;
    int templates_a_frame = 400;  ///< compared; the whole takes as many frames as it needs
    std::size_t candidates = 6;   ///< of one search, verified one a frame
    float find_fitting_share = 0.93f, find_seen_share = 0.4f;
    float keep_fitting_share = 0.75f, keep_seen_share = 0.25f;
    int patience_frames = 6;                         ///< that the last pose is held while it is not confirmed
    float max_step_m = 0.06f, max_step_deg = 15.0f;  ///< from a frame to the next
};

struct HeldObjectFrame {
    HeldObjectState state = HeldObjectState::searching;
    std::string reason;  ///< for people; empty when all is well
    RigidTransform T_c_o =
        RigidTransform::Identity();  ///< object (its volume's frame) to camera; where tracked
    ModelAgreement agreement;
    float rms_mm = 0.0f;
    /// Of six, which the view does not tell (a body of revolution turns unseen): held as they were.
    int held_directions = 0;
};

/// A rigid object of known shape in the hand (Fig 1 E): found in the foreground, then followed in 6DOF by ICP
/// against a raycast of its own volume. Everything is relative to the camera, which may move.
class HeldObject {
  public:
    /// `model`: the object alone, as `scan_file` holds it. Throws Error as restore_volume.
    HeldObject(const Device& device, const HeldObjectConfig& config, const Intrinsics& intrinsics,
               const VolumeSnapshot& model);

    /// `foreground_mask`: not 0 on what is not the background, hands included. Waits for the device.
    HeldObjectFrame process(const LiveMaps& live, const Buffer<std::uint8_t>& foreground_mask);

  private:
    struct Pose {
        RigidTransform T_o_c = RigidTransform::Identity();
        TrackingResult tracking;
        ModelAgreement agreement;
    };

    HeldObjectFrame follow(const LiveMaps& live, const Buffer<std::uint8_t>& mask);
    HeldObjectFrame search(const LiveMaps& live, const Buffer<std::uint8_t>& mask);
    void propose(const LiveMaps& live, const Buffer<std::uint8_t>& mask);
    /// Aligned from a pose that the prediction is of; leaves the prediction at the result.
    Pose align(CameraTracking& tracking, const LiveMaps& live, const Buffer<std::uint8_t>& mask,
               const RigidTransform& T_o_p, std::span<const RigidTransform> guesses);
    void leave_out_others(const LiveMaps& live, const Buffer<std::uint8_t>& mask,
                          const RigidTransform& T_o_c);
    void predict(const RigidTransform& T_o_c);
    HeldObjectFrame tracked_frame(const Pose& pose) const;
    HeldObjectFrame lose(const ModelAgreement& agreement);

    HeldObjectConfig config_;
    Intrinsics intrinsics_;
    TsdfVolume volume_;
    ObjectTemplates templates_;
    CameraTracking tracking_, finding_;
    Raycasting raycasting_;
    Program bounds_program_;
    Kernel mark_outside_;
    SurfacePrediction prediction_;
    Buffer<std::uint8_t> excluded_;
    HeldObjectState state_ = HeldObjectState::searching;
    RigidTransform T_o_c_ = RigidTransform::Identity();  ///< of the prediction while tracked
    RigidTransform velocity_ = RigidTransform::Identity();
    int unconfirmed_frames_ = 0;
    std::optional<ForegroundView> view_;  ///< that is being compared
    std::size_t next_template_ = 0;
    std::vector<ObjectCandidate> found_;      ///< by the comparison so far
    std::vector<RigidTransform> candidates_;  ///< T_c_o that wait for their verification, the best last
    std::string reason_ = "nothing is held before the camera";
};

}  // namespace touchstone
