#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/shared_types.h"

/// The merging of the foreground's predictions in plain C++; row-major pictures without padding.
namespace touchstone::reference {

struct ComponentPick {
    std::vector<std::uint8_t> own, with_free, others;
};

inline ComponentPick pick_component(const std::vector<int>& labels, const std::vector<std::uint8_t>& weights,
                                    int label) {
    ComponentPick pick;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const bool is_own = labels[i] == label;
        pick.own.push_back(is_own ? weights[i] : std::uint8_t{0});
        pick.with_free.push_back(is_own          ? weights[i]
                                 : labels[i] < 0 ? std::uint8_t{SAMPLE_FREE_ONLY}
                                                 : std::uint8_t{0});
        pick.others.push_back(is_own ? 0 : 255);
    }
    return pick;
}

struct ForegroundPicture {
    std::vector<float> depth_m;
    std::vector<std::uint8_t> source;
};

inline ForegroundPicture take_live(const std::vector<std::uint8_t>& mask, const std::vector<float>& live_m) {
    ForegroundPicture picture;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        picture.depth_m.push_back(mask[i] != 0 ? live_m[i] : 0.0f);
        picture.source.push_back(mask[i] != 0 ? FOREGROUND_LIVE : FOREGROUND_NONE);
    }
    return picture;
}

/// A pixel of the component at most two pixels away. Nothing is looked for in the outermost 8 columns and 2
/// rows of the padded map.
inline bool is_beside(const std::vector<int>& labels, const MapShape& shape, int x, int y, int label) {
    const int first = x / 8 * 8;
    if (first < 8 || first + 16 > shape.pitch_px || y < 2 || y + 2 >= shape.rows_px) return false;
    for (int j = y - 2; j <= y + 2; ++j) {
        for (int i = x - 2; i <= x + 2; ++i) {
            if (i >= shape.width_px || j >= shape.height_px) continue;
            if (labels[static_cast<std::size_t>(j * shape.width_px + i)] == label) return true;
        }
    }
    return false;
}

inline void take_prediction(const std::vector<int>& labels, const std::vector<float>& live_m,
                            const std::vector<float>& model_m, const MapShape& shape,
                            const SensorNoise& noise, float gate_sigmas, int label,
                            ForegroundPicture& picture) {
    for (int y = 0; y < shape.height_px; ++y) {
        for (int x = 0; x < shape.width_px; ++x) {
            const auto at = static_cast<std::size_t>(y * shape.width_px + x);
            if (model_m[at] <= 0.0f) continue;
            const float from_offset_m = live_m[at] - noise.offset_m;
            const float sigma_m = noise.constant_m + noise.quadratic * from_offset_m * from_offset_m;
            const bool agrees = std::abs(model_m[at] - live_m[at]) < gate_sigmas * sigma_m;
            const bool is_hole = labels[at] < 0 && live_m[at] <= 0.0f;
            if (!(labels[at] == label && agrees) && !(is_hole && is_beside(labels, shape, x, y, label)))
                continue;
            picture.depth_m[at] = model_m[at];
            picture.source[at] = FOREGROUND_MODEL;
        }
    }
}

}  // namespace touchstone::reference
