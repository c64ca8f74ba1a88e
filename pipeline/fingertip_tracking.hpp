#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pipeline/fingertip_detection.hpp"
#include "pipeline/touch_bias.hpp"
#include "pipeline/touch_event.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

struct FingertipTrackingConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float down_m = 0.004f;  ///< pad lower than this, up to 1 m from the camera: contact
    float sure_sigma_m =
        0.0012f;                  ///< a height less well known than this must be lower to begin a contact ...
    float unsure_gain = 2.0f;     ///< ... by so much of the rest
    float up_m = 0.0065f;         ///< pad higher than this: no contact any more
    float most_noise = 1.6f;      ///< both grow with the noise of depth, to so many times
    float gate_m = 0.045f;        ///< a finger moves at most this far from where it is expected ...
    float gate_steps = 0.5f;      ///< ... plus this times its predicted step
    float new_gate_m = 0.07f;     ///< the same in the second frame, when its speed is not known: 2 m/s
    int bridged_frames = 3;       ///< a finger out of sight this long is still followed
    float hidden_s = 0.3f;        ///< a touch whose place is covered is kept so long
    float hidden_gate_m = 0.07f;  ///< how far from where it is expected it may come back
    float drag_m = 0.008f;        ///< a finger in contact that has moved so far is dragging
    int least_age_frames = 2;     ///< seen this often before it may touch
    float apart_m = 0.014f;       ///< two tips closer than this are one finger, seen twice
    float beside_m = 0.05f;  ///< knuckles and other fingers of a hand that touches are so near its finger ...
    int beside_frames = 2;   ///< ... and touch once they were low in so many frames
    float velocity_gain = 0.6f;           ///< of a new measurement of the velocity
    float most_speed_m_s = 3.0f;          ///< hands are not faster
    float radius_first_sigma_m = 0.001f;  ///< of the radius seen in one frame
    float radius_frames = 20.0f;          ///< frames over which the radius is averaged
    float radius_floor_m = 0.0003f;       ///< the radius is never known better
    float axis_sigma = 0.12f;             ///< radians by which a finger turns in a frame
    float area_margin = 0.05f;            ///< beyond 0..1 of the interactive area
};

/// Whether something else hides a finger that should be there, or the view there is dark. Camera frame.
using CoverTest = std::function<bool(const FingerShape&)>;

struct TrackedTouches {
    std::vector<TouchEvent> touches;
    std::vector<HoverEvent> hovers;
};

/// Follows fingertips from frame to frame, learns how thick each is, and tells touch from hover.
class FingertipTracking {
  public:
    explicit FingertipTracking(const FingertipTrackingConfig& config) : config_(config) {}

    /// Without a test nothing is covered.
    TrackedTouches update(std::span<const FingertipCandidate> tips, const InteractiveArea& area,
                          const Intrinsics& intrinsics, std::uint64_t timestamp_us,
                          const CoverTest& is_covered = {});
    /// Is taken off from the next frame on.
    void set_bias(const TouchBias& bias) { bias_ = bias; }
    /// Where the followed fingers are expected at a time, and their radius.
    std::vector<KnownFinger> expected(std::uint64_t timestamp_us) const;
    /// Ends all touches: the sensor is lost or the camera was moved.
    std::vector<TouchEvent> release_all();

  private:
    struct Track {
        int id = 0;
        FingertipCandidate tip;
        Eigen::Vector3f velocity_m_s{0.f, 0.f, 0.f};
        Fingertip last;  ///< as reported
        RadiusPrior radius;
        int age = 1;              ///< frames in which it was seen
        int missed = 0;           ///< frames since
        int missed_in_sight = 0;  ///< of them, the last ones, in which nothing covered its place
        float unseen_s = 0.f;
        int low = 0;  ///< frames on end in which its pad was lower than down_m
        bool down = false;
        bool was_down = false;                    ///< before this frame
        bool dragged = false;                     ///< since it came down
        Eigen::Vector3f down_c_m{0.f, 0.f, 0.f};  ///< where it came down
    };

    /// Where a track's round end should be now: straight on for a few frames, but not through the surface.
    Eigen::Vector3f expected_center_m(const Track& track, float dt_s) const;
    float gate_of(const Track& track, float dt_s) const;
    void miss(Track& track, float dt_s, const CoverTest& is_covered) const;
    /// Whether a finger that is not seen still counts as what it was.
    bool is_waited_for(const Track& track) const;
    FingerState state_of(const Track& track) const;
    float seconds_since_last(std::uint64_t timestamp_us) const;
    std::vector<int> assign(std::span<const FingertipCandidate> tips, float dt_s) const;
    /// Whether a finger seen in this frame is so close that it is the same.
    bool is_followed(const Eigen::Vector3f& center_m) const;
    bool is_doubled(const Track& track) const;
    /// Whether a finger that touched before this frame is so close that this may be a part of its hand.
    bool is_beside_touch(const Track& track) const;
    /// Of down_m and up_m at this tip.
    float noise_factor(const FingertipCandidate& tip) const;
    /// A pad lower than this comes into contact.
    float down_limit_m(const FingertipCandidate& tip) const;
    bool touches(const Track& track, const Eigen::Vector2f& uv) const;
    void follow(Track& track, const FingertipCandidate& tip, float dt_s) const;
    void report(Track& track, const InteractiveArea& area, const Intrinsics& intrinsics, TrackedTouches& out);

    FingertipTrackingConfig config_;
    TouchBias bias_;
    std::vector<Track> tracks_;
    std::uint64_t last_us_ = 0;
    int next_id_ = 1;
};

}  // namespace touchstone
