#include "tests/accuracy/baselines/dynamic_background.hpp"

#include <cmath>

namespace touchstone::baselines {

void DynamicBackground::add(const DepthPicture& picture) {
    if (window_.empty()) start(picture);
    exchange(picture);
    settle(picture);
}

void DynamicBackground::start(const DepthPicture& picture) {
    const int wide = picture.width_px, high = picture.height_px;
    window_.assign(static_cast<std::size_t>(config_.window_frames), DepthPicture(wide, high));
    count_ = Raster<int>(wide, high);
    sum_mm_ = sum_mm2_ = Raster<std::int64_t>(wide, high);
    background_ = {Raster<float>(wide, high), Raster<float>(wide, high)};
}

void DynamicBackground::exchange(const DepthPicture& picture) {
    DepthPicture& oldest = window_[oldest_];
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        const std::int64_t in = picture.values[i], out = oldest.values[i];
        count_.values[i] += (in > 0 ? 1 : 0) - (out > 0 ? 1 : 0);
        sum_mm_.values[i] += in - out;
        sum_mm2_.values[i] += in * in - out * out;
    }
    oldest = picture;
    oldest_ = (oldest_ + 1) % window_.size();
}

void DynamicBackground::settle(const DepthPicture& picture) {
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        float &mean_mm = background_.mean_mm.values[i], &sd_mm = background_.sd_mm.values[i];
        if (mean_mm > 0.0F && static_cast<float>(picture.values[i]) > mean_mm + config_.dropped_sd * sd_mm)
            mean_mm = 0.0F;
        if (count_.values[i] < config_.least_readings) continue;
        const double count = count_.values[i];
        const double mean = static_cast<double>(sum_mm_.values[i]) / count;
        const double variance = static_cast<double>(sum_mm2_.values[i]) / count - mean * mean;
        const double stable_mm = static_cast<double>(config_.stable_mm_m2) * mean * mean * 1e-6;
        const bool nearer = mean_mm > 0.0F && mean < static_cast<double>(mean_mm - config_.halo_mm);
        if (variance >= stable_mm * stable_mm || nearer) continue;
        mean_mm = static_cast<float>(mean);
        sd_mm = static_cast<float>(std::sqrt(std::max(0.0, variance)));
    }
}

}  // namespace touchstone::baselines
