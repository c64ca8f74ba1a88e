#include "tests/accuracy/baselines/band_touch.hpp"
#include "tests/accuracy/baselines/baseline.hpp"
#include "tests/accuracy/baselines/direct_depth.hpp"
#include "tests/accuracy/baselines/omni_touch.hpp"
#include "tests/accuracy/baselines/world_kit.hpp"

namespace touchstone::baselines {
namespace {

/// Fingers of 5 to 25 mm at the pixels of a Kinect v1 0.7 to 1.4 m away.
OmniTouchConfig kinect_omni_touch() {
    OmniTouchConfig config;
    config.slices.most_width_px = 14;
    return config;
}

/// A Kinect v1 spreads by 1.4 mm at 1 m, and in pieces between its steps by more.
DirectDepthConfig kinect_direct_depth() {
    DirectDepthConfig config;
    config.background.stable_mm_m2 = 3.0F;
    config.zones.noise_below_sd = 2.0F;
    config.zones.low_below_mm = 16.0F;
    config.touch_below_mm = 1.5F;
    return config;
}

}  // namespace

std::vector<Method> published_methods() {
    std::vector<Method> methods;
    methods.push_back({"Wilson single", std::make_unique<BandTouch>(wilson_single())});
    methods.push_back({"Wilson max", std::make_unique<BandTouch>(wilson_max())});
    methods.push_back({"Wilson stat", std::make_unique<BandTouch>(wilson_stat())});
    methods.push_back({"WorldKit", std::make_unique<WorldKit>(WorldKitConfig{})});
    methods.push_back({"OmniTouch", std::make_unique<OmniTouch>(OmniTouchConfig{})});
    methods.push_back({"DIRECT depth", std::make_unique<DirectDepth>(DirectDepthConfig{})});
    methods.push_back({"KinectTouch", std::make_unique<BandTouch>(kinect_touch())});
    return methods;
}

std::vector<Method> tuned_methods() {
    std::vector<Method> methods;
    methods.push_back({"Wilson stat, tuned", std::make_unique<BandTouch>(wilson_stat_for_steps())});
    methods.push_back({"OmniTouch, tuned", std::make_unique<OmniTouch>(kinect_omni_touch())});
    methods.push_back({"DIRECT depth, tuned", std::make_unique<DirectDepth>(kinect_direct_depth())});
    return methods;
}

}  // namespace touchstone::baselines
