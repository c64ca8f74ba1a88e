#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace touchstone {

/// The value below which `percent` (0..100) of the values lie, linear between the two nearest ranks as in
/// NumPy. 0 for no values.
inline double percentile(std::vector<double> values, double percent) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const double rank = std::clamp(percent, 0.0, 100.0) / 100.0 * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(std::floor(rank));
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (rank - std::floor(rank)) * (values[above] - values[below]);
}

}  // namespace touchstone
