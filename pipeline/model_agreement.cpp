#include "pipeline/model_agreement.hpp"

#include <algorithm>

namespace touchstone {

float ModelAgreement::fitting_share() const {
    return static_cast<float>(fits) / static_cast<float>(std::max(1, fits + through));
}

float ModelAgreement::seen_share() const {
    return static_cast<float>(fits) / static_cast<float>(std::max(1, predicted));
}

ModelAgreement compare_model(const ModelAgreementConfig& config, const MaskedDepth& live,
                             std::span<const float> predicted_m) {
    ModelAgreement agreement;
    for (int y = 0; y < live.intrinsics.height_px; ++y) {
        for (int x = 0; x < live.intrinsics.width_px; ++x) {
            const auto at = static_cast<std::size_t>(y * live.pitch_px + x);
            const float model = predicted_m[at];
            if (model <= 0.0f) continue;
            ++agreement.predicted;
            const float z = live.depth_m[at];
            if (z <= 0.0f) continue;
            const float from_offset = model - config.noise.offset_m;
            const float sigma = config.noise.constant_m + config.noise.quadratic * from_offset * from_offset;
            const float tolerance = std::max(config.least_tolerance_m, config.sigmas * sigma);
            const bool in_front = z<model - tolerance, behind = z> model + tolerance;
            agreement.hidden += in_front;
            agreement.through += behind || (!in_front && live.mask[at] == 0);
            agreement.fits += !in_front && !behind && live.mask[at] != 0;
        }
    }
    return agreement;
}

}  // namespace touchstone
