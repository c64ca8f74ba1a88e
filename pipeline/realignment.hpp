#pragma once

#include "pipeline/relocalisation.hpp"

namespace touchstone {

struct RealignmentConfig {
    RelocalisationConfig relocalisation;
    int still_frames = 2;  ///< that find the camera where the frame before found it
    float still_m = 0.004f, still_deg = 0.25f;
    float max_shift_m = 0.25f, max_turn_deg = 15.0f;  ///< from the pose it starts at; more is not believed
    int most_frames = 150;         ///< without success, of those that show something: given up
    float min_valid_share = 0.1f;  ///< of pixels with a depth; a frame with fewer shows nothing
};

/// From a knock, or from the start with a saved scan, until the fixed camera's pose is known and it stands
/// still.
class Realignment {
  public:
    enum class Outcome { searching, found, given_up };

    Realignment(const Device& device, const RealignmentConfig& config, const Intrinsics& intrinsics)
        : config_(config), relocalisation_(device, config.relocalisation, intrinsics) {}

    /// Begins a search around the pose.
    void start(const RigidTransform& T_g_last);
    Outcome step(const LiveMaps& live, const DepthView& view, const TsdfVolume& volume,
                 const KeyframeDatabase* keyframes);
    /// When found: the camera's pose.
    const RigidTransform& T_g_c() const { return T_g_c_; }
    const TrackingResult& tracking() const { return relocalisation_.tracking(); }

  private:
    bool is_too_far(const RigidTransform& T_g_found) const;

    RealignmentConfig config_;
    Relocalisation relocalisation_;
    RigidTransform T_g_start_ = RigidTransform::Identity();
    RigidTransform T_g_c_ = RigidTransform::Identity();  ///< where it was last
    bool seen_ = false;                                  ///< by the last frame, at T_g_c_
    int still_ = 0, frames_ = 0;
};

}  // namespace touchstone
