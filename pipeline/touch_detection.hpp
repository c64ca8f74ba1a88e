#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/finger_cover.hpp"
#include "pipeline/fingertip_detection.hpp"
#include "pipeline/fingertip_tracking.hpp"
#include "pipeline/maps.hpp"
#include "pipeline/touch_event.hpp"
#include "pipeline/touch_map.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

struct TouchDetectionConfig {
    int margin_px = 4;  ///< around the foreground's regions: its edges are lost to the mask
    TouchMapConfig map;
    FingertipDetectionConfig fingertips;
    FingertipTrackingConfig tracking;
    FingerCoverConfig cover;
};

/// What touches are looked for in. All maps have the camera's MapShape.
struct TouchInput {
    const LiveMaps& live;
    const SurfacePrediction& background;
    const Buffer<std::uint8_t>& mask;      ///< other than 0: foreground
    std::span<const PixelRegion> regions;  ///< around its parts
    InteractiveArea area;
    std::uint64_t timestamp_us = 0;  ///< of the depth picture
};

/// Touches on any surface (Listing 4, Fig 10): touch map, fingertips by shape, tracks over time.
class TouchDetection {
  public:
    TouchDetection(const Device& device, const TouchDetectionConfig& config, const Intrinsics& intrinsics);

    TrackedTouches detect(const TouchInput& input);
    /// Is taken off the places of touches from the next frame on.
    void set_bias(const TouchBias& bias) { tracking_.set_bias(bias); }
    /// Ends all touches: the sensor is lost or the camera was moved.
    std::vector<TouchEvent> release_all() { return tracking_.release_all(); }
    /// Of the last detect().
    const TouchMap& touch_map() const { return map_; }
    const std::vector<FingertipCandidate>& candidates() const { return candidates_; }

  private:
    TouchDetectionConfig config_;
    Intrinsics intrinsics_;
    TouchMapping mapping_;
    TouchMap map_;
    FingertipTracking tracking_;
    std::vector<FingertipCandidate> candidates_;
};

}  // namespace touchstone
