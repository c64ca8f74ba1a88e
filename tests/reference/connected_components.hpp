#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

/// Depth-aware connected components as a flood fill over a row-major picture without padding.
namespace touchstone::reference {

struct FloodComponent {
    int pixels = 0, seeds = 0, unknowns = 0, expected = 0;
    int min_x = 1 << 30, min_y = 1 << 30, max_x = -1, max_y = -1;
    double depth_sum_m = 0.0;
};

struct FloodResult {
    std::vector<int> labels;  ///< -1 = none; numbered in the order of first pixels, row by row
    std::vector<FloodComponent> components;
};

inline bool connected(const ConnectionParams& params, float a_m, float b_m) {
    const float z = std::min(a_m, b_m), from_offset = z - params.noise.offset_m;
    const float sigma_z = params.noise.constant_m + params.noise.quadratic * from_offset * from_offset;
    return std::abs(a_m - b_m) < std::max(params.gap_sigmas * sigma_z, params.gap_per_m * z);
}

inline FloodResult flood_fill(const std::vector<std::uint8_t>& members, const std::vector<float>& depth_m,
                              int width_px, int height_px, const ConnectionParams& params) {
    FloodResult result{std::vector<int>(members.size(), -1), {}};
    const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * width_px + x); };
    std::vector<std::pair<int, int>> open;
    const auto visit = [&](int x, int y, std::size_t from, int label) {
        if (x < 0 || y < 0 || x >= width_px || y >= height_px) return;
        const std::size_t at = index(x, y);
        if (members[at] == 0 || result.labels[at] >= 0) return;
        if (from != at && !connected(params, depth_m[from], depth_m[at])) return;
        result.labels[at] = label;
        FloodComponent& c = result.components[static_cast<std::size_t>(label)];
        ++c.pixels;
        const int kind = members[at] & (MEMBER_EXPECTED - 1);
        c.seeds += kind == MEMBER_SEED;
        c.unknowns += kind == MEMBER_UNKNOWN;
        c.expected += (members[at] & MEMBER_EXPECTED) != 0;
        c.min_x = std::min(c.min_x, x), c.max_x = std::max(c.max_x, x);
        c.min_y = std::min(c.min_y, y), c.max_y = std::max(c.max_y, y);
        c.depth_sum_m += static_cast<double>(depth_m[at]);
        open.emplace_back(x, y);
    };
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            if (members[index(x, y)] == 0 || result.labels[index(x, y)] >= 0) continue;
            result.components.emplace_back();
            const int label = static_cast<int>(result.components.size()) - 1;
            visit(x, y, index(x, y), label);
            while (!open.empty()) {
                const auto [i, j] = open.back();
                open.pop_back();
                const std::size_t from = index(i, j);
                visit(i - 1, j, from, label), visit(i + 1, j, from, label);
                visit(i, j - 1, from, label), visit(i, j + 1, from, label);
            }
        }
    }
    return result;
}

}  // namespace touchstone::reference
