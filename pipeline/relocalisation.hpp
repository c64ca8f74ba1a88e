#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pipeline/camera_tracking.hpp"
#include "pipeline/keyframes.hpp"
#include "pipeline/raycasting.hpp"

namespace touchstone {

/// Tracking from far away to exactly: the coarse level reaches far, at the finest only what fits counts.
inline CameraTrackingConfig relocalisation_tracking() {
    CameraTrackingConfig config;
    config.levels = {TrackingLevel{5, 0.06f, 4.0f}, TrackingLevel{6, 0.08f, 16.0f},
                     TrackingLevel{12, 0.30f, 80.0f}};
    return config;
}

struct RelocalisationConfig {
    CameraTrackingConfig tracking = relocalisation_tracking();
    float turn_deg = 4.0f;           ///< of the poses around the last good one
    float guess_turn_deg = 3.0f;     ///< of the guesses of ICP at each pose
    float guess_shift_m = 0.04f;     ///< the same
    std::size_t most_keyframes = 3;  ///< that are tried in a round

    float min_inlier_share = 0.55f;    ///< of the live pixels that have a model; less is no place
    float sure_inlier_share = 0.975f;  ///< as many: found; fewer: found when nothing better is in the round
    float better_share = 0.01f;        ///< by which a place must be better than one nearer to the last pose
    float coarse_loss = 0.3f;       ///< a place found at the coarse levels gains at most this at the finest
    float min_model_share = 0.40f;  ///< of the live pixels
    float max_rms_sigmas = 2.0f;
    float max_check_step_m = 0.030f, max_check_step_deg = 2.0f;  ///< ICP at the found pose stays there
};

/// Where the camera is in a volume, when tracking has lost it: around the last good pose, then from the
/// keyframes. A pose counts only when tracking against its own prediction is good and stays there.
class Relocalisation {
  public:
    Relocalisation(const Device& device, const RelocalisationConfig& config, const Intrinsics& intrinsics);

    /// Tries one pose or verifies one (a frame's work is one raycast and one alignment) and goes on in the
    /// next call; T_g_c when found. `live` and `view` are the same frame. `keyframes` may be null.
    std::optional<RigidTransform> step(const LiveMaps& live, const DepthView& view, const TsdfVolume& volume,
                                       const RigidTransform& T_g_last, const KeyframeDatabase* keyframes);
    /// T_g_c where the camera is still at, or within ICP's reach of, a pose that it was found at.
    std::optional<RigidTransform> confirm(const LiveMaps& live, const TsdfVolume& volume,
                                          const RigidTransform& T_g_found);
    /// The search begins anew, at the last good pose.
    void restart();
    /// Tracking at the pose last found.
    const TrackingResult& tracking() const { return tracking_result_; }

  private:
    struct Place {
        RigidTransform T_g_c = RigidTransform::Identity();
        TrackingResult tracking;
    };

    std::optional<RigidTransform> next_candidate(const DepthView& view, const RigidTransform& T_g_last,
                                                 const KeyframeDatabase* keyframes);
    std::optional<Place> align(const LiveMaps& live, const TsdfVolume& volume, const RigidTransform& T_g_p,
                               std::size_t guesses);
    float best_share() const;
    std::optional<Place> verify(const LiveMaps& live, const TsdfVolume& volume, const RigidTransform& T_g_p);

    std::optional<RigidTransform> found(const std::optional<Place>& place);

    RelocalisationConfig config_;
    CameraTracking coarse_tracking_, tracking_;
    Raycasting raycasting_;
    SurfacePrediction prediction_;
    std::vector<RigidTransform> around_, guesses_;  ///< T_p_c
    std::vector<KeyframeMatch> matches_;
    std::size_t next_ = 0;
    std::optional<RigidTransform> pending_;  ///< T_g_c that the next frame verifies
    std::optional<Place> best_;              ///< of this round
    TrackingResult tracking_result_;
};

/// How far a transform takes the origin, and by how much it turns.
struct Displacement {
    float shift_m = 0.0f, turn_deg = 0.0f;
};
Displacement displacement(const RigidTransform& T);

/// Identity, then turns about each axis and shifts along it, to and fro; none where the size is 0.
std::vector<RigidTransform> poses_around(float turn_deg, float shift_m);

}  // namespace touchstone
