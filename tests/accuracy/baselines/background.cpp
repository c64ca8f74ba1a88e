#include "tests/accuracy/baselines/background.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone::baselines {

void Readings::add(const DepthPicture& picture) {
    if (frames_++ == 0) {
        count_ = Raster<int>(picture.width_px, picture.height_px);
        sum_mm_ = sum_mm2_ = Raster<double>(picture.width_px, picture.height_px);
        largest_mm_ = DepthPicture(picture.width_px, picture.height_px);
    }
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        const double mm = picture.values[i];
        count_.values[i] += mm > 0.0 ? 1 : 0;
        sum_mm_.values[i] += mm;
        sum_mm2_.values[i] += mm * mm;
        largest_mm_.values[i] = std::max(largest_mm_.values[i], picture.values[i]);
    }
}

Background Readings::statistics() const {
    Background result{Raster<float>(count_.width_px, count_.height_px), {}};
    result.sd_mm = result.mean_mm;
    for (std::size_t i = 0; i < count_.values.size(); ++i) {
        if (count_.values[i] == 0) continue;
        const double mean_mm = sum_mm_.values[i] / count_.values[i];
        const double variance_mm2 = sum_mm2_.values[i] / count_.values[i] - mean_mm * mean_mm;
        result.mean_mm.values[i] = static_cast<float>(mean_mm);
        result.sd_mm.values[i] = static_cast<float>(std::sqrt(std::max(0.0, variance_mm2)));
    }
    return result;
}

Background Readings::largest() const { return background_of(largest_mm_); }

Background background_of(const DepthPicture& picture) {
    Background result{Raster<float>(picture.width_px, picture.height_px), {}};
    result.sd_mm = result.mean_mm;
    std::copy(picture.values.begin(), picture.values.end(), result.mean_mm.values.begin());
    return result;
}

}  // namespace touchstone::baselines
