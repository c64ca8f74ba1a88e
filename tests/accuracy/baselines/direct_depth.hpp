#pragma once

#include <map>

#include "tests/accuracy/baselines/baseline.hpp"
#include "tests/accuracy/baselines/direct_fingers.hpp"
#include "tests/accuracy/baselines/dynamic_background.hpp"
#include "tests/accuracy/baselines/point_tracker.hpp"

namespace touchstone::baselines {

struct DirectDepthConfig {
    DynamicBackgroundConfig background;
    ZoneConfig zones;
    FingerConfig fingers;
    float touch_below_mm = 0.5F;
    float release_above_mm = 2.5F;
    float newest_share = 0.5F;  ///< of a smoothed height
    double gate_px = 50.0;
    int missing_frames = 3;
};

/// The part of DIRECT (2016) that uses depth alone. Its infrared edges, which a Kinect v1 does not give
/// together with depth, are left out: the noise around a tip is bounded by its number of pixels only.
class DirectDepth : public Baseline {
  public:
    explicit DirectDepth(const DirectDepthConfig& config)
        : config_(config), background_(config.background), tracker_(config.gate_px, config.missing_frames) {}

    std::vector<PixelTouch> process(const DepthPicture& picture) override;

  private:
    struct State {
        float height_mm;
        bool touches;
    };

    bool touches(int id, float height_mm);

    DirectDepthConfig config_;
    DynamicBackground background_;
    PointTracker tracker_;
    std::map<int, State> states_;
};

}  // namespace touchstone::baselines
