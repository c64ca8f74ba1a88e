#pragma once

#include <vector>

#include "tests/accuracy/baselines/background.hpp"

namespace touchstone::baselines {

struct DynamicBackgroundConfig {
    int window_frames = 100;
    int least_readings = 30;
    float stable_mm_m2 = 1.0F;  ///< spread below which a pixel is stable, at 1 m; grows with the square
    float dropped_sd = 10.0F;   ///< a reading so many spreads behind the background ends it
    float halo_mm = 5.0F;       ///< what is nearer than the background by more never becomes part of it
};

/// DIRECT's background: of each pixel, mean and spread of the last frames whenever they are stable.
class DynamicBackground {
  public:
    explicit DynamicBackground(const DynamicBackgroundConfig& config) : config_(config) {}

    void add(const DepthPicture& picture);
    /// Mean 0 where nothing has been stable yet.
    const Background& get() const { return background_; }

  private:
    void start(const DepthPicture& picture);
    void exchange(const DepthPicture& picture);
    void settle(const DepthPicture& picture);

    DynamicBackgroundConfig config_;
    std::vector<DepthPicture> window_;
    std::size_t oldest_ = 0;
    Raster<int> count_;
    Raster<std::int64_t> sum_mm_, sum_mm2_;
    Background background_;
};

}  // namespace touchstone::baselines
