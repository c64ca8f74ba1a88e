#include "tests/accuracy/baselines/band_touch.hpp"

#include <algorithm>

#include "tests/accuracy/baselines/blobs.hpp"
#include "tests/accuracy/baselines/boxcar.hpp"

namespace touchstone::baselines {

std::vector<PixelTouch> BandTouch::process(const DepthPicture& picture) {
    if (!background_) {
        learn(picture);
        return {};
    }
    const Mask smooth = boxcar(band(picture), config_.boxcar_px, config_.boxcar_kept_above);
    std::vector<Eigen::Vector2d> points_px;
    for (const Blob& blob : find_blobs(smooth, config_.least_px))
        points_px.push_back(centroid_px(blob, picture.width_px));
    return follow(tracker_, points_px);
}

void BandTouch::learn(const DepthPicture& picture) {
    using enum BandTouchConfig::Kind;
    readings_.add(picture);
    if (readings_.frames() < config_.background_frames) return;
    background_ = config_.background == one_frame ? background_of(picture)
                  : config_.background == largest ? readings_.largest()
                                                  : readings_.statistics();
}

Mask BandTouch::band(const DepthPicture& picture) const {
    Mask mask(picture.width_px, picture.height_px);
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
        const float mm = height_mm(*background_, picture, i);
        const float spread_mm = background_->sd_mm.values[i] + config_.added_sd_mm;
        const bool high = mm >= config_.least_mm && mm > config_.least_sd * spread_mm;
        if (high && mm <= config_.most_mm) mask.values[i] = set_value;
    }
    return mask;
}

namespace {

BandTouchConfig wilson() {
    BandTouchConfig config;
    config.boxcar_px = 7;
    config.boxcar_kept_above = 50;
    config.least_px = 5;
    config.gate_px = 100.0;
    config.missing_frames = 3;
    return config;
}

}  // namespace

BandTouchConfig wilson_single() {
    BandTouchConfig config = wilson();
    config.background = BandTouchConfig::Kind::one_frame;
    config.background_frames = 30;
    config.least_mm = 6.0F;
    config.most_mm = 12.0F;
    return config;
}

BandTouchConfig wilson_max() {
    BandTouchConfig config = wilson();
    config.background = BandTouchConfig::Kind::largest;
    config.background_frames = 16;
    config.least_mm = 8.0F;
    config.most_mm = 16.0F;
    return config;
}

BandTouchConfig wilson_stat() {
    BandTouchConfig config = wilson();
    config.background = BandTouchConfig::Kind::statistics;
    config.background_frames = 100;
    config.least_sd = 4.0F;
    config.most_mm = 19.999F;
    config.boxcar_kept_above = 100;
    return config;
}

BandTouchConfig wilson_stat_for_steps() {
    BandTouchConfig config = wilson_stat();
    config.added_sd_mm = 1.0F;
    config.boxcar_kept_above = 50;
    config.least_px = 10;
    return config;
}

BandTouchConfig kinect_touch() {
    BandTouchConfig config;
    config.background = BandTouchConfig::Kind::one_frame;
    config.background_frames = 1;
    config.least_mm = 10.001F;
    config.most_mm = 19.999F;
    config.least_px = 51;
    return config;
}

}  // namespace touchstone::baselines
