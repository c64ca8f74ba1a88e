#pragma once

#include <optional>

#include "tests/accuracy/baselines/background.hpp"
#include "tests/accuracy/baselines/baseline.hpp"
#include "tests/accuracy/baselines/point_tracker.hpp"

namespace touchstone::baselines {

/// WorldKit (2013): a blob grows from core pixels, which stand out of the background, into pixels that do so
/// less. Heights are relative: in units of the background's spread and 1 mm.
struct WorldKitConfig {
    int background_frames = 100;
    float added_sd_mm = 1.0F;
    float least_relative = 3.0F;
    float least_relative_of_core = 6.0F;
    float most_mm = 30.0F;
    std::size_t least_px = 10;
    int least_core_px = 5;
    double gate_px = 100.0;
    int missing_frames = 3;
};

class WorldKit : public Baseline {
  public:
    explicit WorldKit(const WorldKitConfig& config)
        : config_(config), tracker_(config.gate_px, config.missing_frames) {}

    std::vector<PixelTouch> process(const DepthPicture& picture) override;

  private:
    WorldKitConfig config_;
    Readings readings_;
    std::optional<Background> background_;
    PointTracker tracker_;
};

}  // namespace touchstone::baselines
