#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "kernels/shared_types.h"

/// The kernels around the connected components in plain C++, pixel by pixel. Pictures are row-major without
/// padding.
namespace touchstone::reference {

template <class T>
struct Grid {
    int width_px = 0, height_px = 0;
    std::vector<T> values;

    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_px && y < height_px; }
    T at(int x, int y) const {
        return inside(x, y) ? values[static_cast<std::size_t>(y * width_px + x)] : T{};
    }
};

inline float depth_tolerance_m(const CandidateParams& params, float z) {
    const float from_offset = z - params.noise.offset_m;
    const float sigma = params.noise.constant_m + params.noise.quadratic * from_offset * from_offset;
    return params.sigmas_high * std::hypot(sigma, params.quantisation_per_m * z * z);
}

inline ComponentMember mark_candidate(const Grid<std::uint8_t>& codes, const Grid<float>& live_m,
                                      const Grid<float>& model_m, const Grid<float>& fallback_m, int x, int y,
                                      const CandidateParams& params) {
    const int code = codes.at(x, y);
    if (code == ASSOCIATION_SLIGHTLY_IN_FRONT) return MEMBER_GROWTH;
    if (code != ASSOCIATION_IN_FRONT && code != ASSOCIATION_NO_MODEL) return MEMBER_NONE;
    const float live = live_m.at(x, y), tolerance = depth_tolerance_m(params, live);
    float nearest = std::numeric_limits<float>::max();
    for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
            if (model_m.at(x + i, y + j) > 0.0f) nearest = std::min(nearest, model_m.at(x + i, y + j));
        }
    }
    const bool none_around = nearest == std::numeric_limits<float>::max();
    const bool before_all = live < nearest - tolerance;
    if (code == ASSOCIATION_NO_MODEL) {
        if (none_around) return live < params.unknown_depth_m - tolerance ? MEMBER_UNKNOWN : MEMBER_GROWTH;
        return before_all ? MEMBER_SEED : MEMBER_GROWTH;
    }
    const float model = model_m.at(x, y) > 0.0f ? model_m.at(x, y) : fallback_m.at(x, y);
    const bool edge = nearest < model - (params.jump_per_m * live + tolerance);
    return !edge || before_all ? MEMBER_SEED : MEMBER_GROWTH;
}

inline std::uint8_t keep_supported_seed(const Grid<std::uint8_t>& members, const Grid<std::uint8_t>& held,
                                        int least_held, int x, int y) {
    if (members.at(x, y) == MEMBER_NONE) return MEMBER_NONE;
    const int expected = held.at(x, y) >= least_held ? int{MEMBER_EXPECTED} : 0;
    if (members.at(x, y) == MEMBER_GROWTH) return static_cast<std::uint8_t>(MEMBER_GROWTH | expected);
    int around = 0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) around += members.at(x + i, y + j) != 0;
    }
    return static_cast<std::uint8_t>((around >= 7 ? int{members.at(x, y)} : int{MEMBER_GROWTH}) | expected);
}

inline bool any_near(const Grid<std::uint8_t>& mask, int x, int y, int radius_px) {
    for (int j = -radius_px; j <= radius_px; ++j) {
        for (int i = -radius_px; i <= radius_px; ++i) {
            if (mask.at(x + i, y + j) != 0) return true;
        }
    }
    return false;
}

/// Frames left in `held` and depth in `fallback_m` after one frame.
inline void mask_background(const Grid<std::uint8_t>& mask, const Grid<float>& live_m,
                            const Grid<float>& model_m, Grid<std::uint8_t>& held, Grid<float>& fallback_m,
                            int radius_px, int hold_frames) {
    for (int y = 0; y < mask.height_px; ++y) {
        for (int x = 0; x < mask.width_px; ++x) {
            const auto u = static_cast<std::size_t>(y * mask.width_px + x);
            held.values[u] = static_cast<std::uint8_t>(
                any_near(mask, x, y, radius_px) ? hold_frames + 1 : std::max(0, held.values[u] - 1));
            const float live = live_m.values[u];
            float& fallback = fallback_m.values[u];
            if (held.values[u] != 0 || live <= 0.0f || model_m.values[u] > 0.0f) continue;
            fallback = fallback > 0.0f ? fallback + (live - fallback) / 16.0f : live;
        }
    }
}

}  // namespace touchstone::reference
