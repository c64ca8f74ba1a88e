#pragma once

#include "tests/accuracy/baselines/raster.hpp"

namespace touchstone::baselines {

/// Of each pixel's readings; 0 where there was none.
struct Background {
    Raster<float> mean_mm, sd_mm;
};

/// Collects the readings of each pixel.
class Readings {
  public:
    void add(const DepthPicture& picture);
    int frames() const { return frames_; }
    Background statistics() const;
    /// The largest reading of each pixel, with a spread of 0.
    Background largest() const;

  private:
    int frames_ = 0;
    Raster<int> count_;
    Raster<double> sum_mm_, sum_mm2_;
    DepthPicture largest_mm_;
};

/// One picture as a background, with a spread of 0.
Background background_of(const DepthPicture& picture);

/// How far a reading is in front of the background, mm; below -10000 where one of them is missing.
inline float height_mm(const Background& background, const DepthPicture& picture, std::size_t i) {
    constexpr float missing_mm = -20000.0F;
    const float behind_mm = background.mean_mm.values[i];
    const std::uint16_t reading_mm = picture.values[i];
    return behind_mm > 0.0F && reading_mm != 0 ? behind_mm - static_cast<float>(reading_mm) : missing_mm;
}

}  // namespace touchstone::baselines
