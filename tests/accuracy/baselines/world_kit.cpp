#include "tests/accuracy/baselines/world_kit.hpp"

#include <algorithm>

#include "tests/accuracy/baselines/blobs.hpp"

namespace touchstone::baselines {

std::vector<PixelTouch> WorldKit::process(const DepthPicture& picture) {
    if (!background_) {
        readings_.add(picture);
        if (readings_.frames() == config_.background_frames) background_ = readings_.statistics();
        return {};
    }
    Mask grown(picture.width_px, picture.height_px), core = grown;
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        const float mm = height_mm(*background_, picture, i);
        const float relative = mm / (background_->sd_mm.values[i] + config_.added_sd_mm);
        if (mm > config_.most_mm || relative < config_.least_relative) continue;
        grown.values[i] = set_value;
        core.values[i] = relative >= config_.least_relative_of_core ? set_value : std::uint8_t{0};
    }
    std::vector<Eigen::Vector2d> points_px;
    for (const Blob& blob : find_blobs(grown, config_.least_px)) {
        const auto cores =
            std::count_if(blob.begin(), blob.end(), [&](std::size_t i) { return core.values[i] != 0; });
        if (cores >= config_.least_core_px) points_px.push_back(centroid_px(blob, picture.width_px));
    }
    return follow(tracker_, points_px);
}

}  // namespace touchstone::baselines
