#pragma once

#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

namespace touchstone::reference {

struct ResidualHistogram {
    std::vector<float> counts, sums_per_m;  ///< DRIFT_BINS each
};

/// Residuals in 1/z of one column in the rows of one zone. Pictures are row-major without padding.
inline ResidualHistogram column_residuals(const std::vector<float>& live_m, const std::vector<float>& model_m,
                                          const std::vector<std::uint8_t>& excluded, int width_px,
                                          int height_px, int column, int zone, const DriftParams& params) {
    ResidualHistogram histogram{std::vector<float>(DRIFT_BINS, 0.0f), std::vector<float>(DRIFT_BINS, 0.0f)};
    const int rows = (height_px + DRIFT_ZONES - 1) / DRIFT_ZONES;
    for (int y = zone * rows; y < (zone + 1) * rows && y < height_px; ++y) {
        const auto u = static_cast<std::size_t>(y * width_px + column);
        if ((y - zone * rows) % params.row_step != params.first_row) continue;
        if (live_m[u] <= 0.0f || model_m[u] <= 0.0f || excluded[u] != 0) continue;
        const float residual = 1.0f / live_m[u] - 1.0f / model_m[u];
        for (int bin = 0; bin < DRIFT_BINS; ++bin) {
            const float from = params.bin_per_m * static_cast<float>(bin - DRIFT_BINS / 2);
            if (residual < from || residual >= from + params.bin_per_m) continue;
            histogram.counts[static_cast<std::size_t>(bin)] += 1.0f;
            histogram.sums_per_m[static_cast<std::size_t>(bin)] += residual;
        }
    }
    return histogram;
}

}  // namespace touchstone::reference
