#pragma once

#include "tests/accuracy/baselines/baseline.hpp"
#include "tests/accuracy/baselines/finger_slices.hpp"
#include "tests/accuracy/baselines/point_tracker.hpp"

namespace touchstone::baselines {

/// OmniTouch (2011) needs no background: a finger is a chain of slices, and it touches where a flood from its
/// tip runs out of it.
struct OmniTouchConfig {
    SliceConfig slices;
    int flood_step_mm = 13;       ///< between neighbours
    std::size_t flood_px = 2000;  ///< ours: the notes give the step alone
    int beyond_tip_px = 8;        ///< ours: where the two ends of a chain are told apart
    double same_tip_px = 10.0;    ///< ours: nearer tips are of one finger, found along rows and columns
    double gate_px = 100.0;
    int missing_frames = 3;
};

class OmniTouch : public Baseline {
  public:
    explicit OmniTouch(const OmniTouchConfig& config)
        : config_(config), tracker_(config.gate_px, config.missing_frames) {}

    std::vector<PixelTouch> process(const DepthPicture& picture) override;

  private:
    OmniTouchConfig config_;
    PointTracker tracker_;
};

/// Turns a chain so that it ends at the tip: beyond a tip it goes farther down than beyond the knuckle.
SliceChain with_tip_last(SliceChain chain, const DepthPicture& picture, int beyond_tip_px);

/// How many pixels a flood from a chain's last slice reaches, up to `most_px`: from neighbour to neighbour
/// with a depth that differs by at most `step_mm`, and not behind the middle of the chain.
std::size_t flood_px(const DepthPicture& picture, const SliceChain& chain, int step_mm, std::size_t most_px);

}  // namespace touchstone::baselines
