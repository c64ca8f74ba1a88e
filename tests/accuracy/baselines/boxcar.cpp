#include "tests/accuracy/baselines/boxcar.hpp"

#include <algorithm>

namespace touchstone::baselines {
namespace {

/// Sums of `side` neighbours along a line of `count` values that lie `stride` apart.
template <class In>
void sum_line(const In* in, int* out, int count, int stride, int side) {
    const int half = side / 2;
    int sum = 0;
    for (int i = 0; i < std::min(half, count); ++i) sum += in[i * stride];
    for (int i = 0; i < count; ++i) {
        if (i + half < count) sum += in[(i + half) * stride];
        if (i - half - 1 >= 0) sum -= in[(i - half - 1) * stride];
        out[i * stride] = sum;
    }
}

}  // namespace

Mask boxcar(const Mask& mask, int side_px, int kept_above) {
    Raster<int> rows(mask.width_px, mask.height_px), sums = rows;
    for (int v = 0; v < mask.height_px; ++v)
        sum_line(&mask.at(0, v), &rows.at(0, v), mask.width_px, 1, side_px);
    for (int u = 0; u < mask.width_px; ++u)
        sum_line(&rows.at(u, 0), &sums.at(u, 0), mask.height_px, mask.width_px, side_px);
    Mask kept(mask.width_px, mask.height_px);
    const int bound = kept_above * side_px * side_px;
    std::transform(sums.values.begin(), sums.values.end(), kept.values.begin(),
                   [bound](int sum) { return sum > bound ? set_value : std::uint8_t{0}; });
    return kept;
}

}  // namespace touchstone::baselines
