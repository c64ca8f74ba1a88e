#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/types.hpp"

namespace touchstone {

/// Coarse view of the foreground along the line to its bulkiest place. Frame v: origin there, x right, y
/// down, z away from the camera.
struct ForegroundView {
    enum class Cell : std::uint8_t { unknown, empty, seen };

    static constexpr int side = 64;
    RigidTransform T_c_v = RigidTransform::Identity();
    std::vector<Cell> cells;     ///< side x side, (side / 2, side / 2) about the origin
    std::vector<float> depth_m;  ///< z_v of seen cells, mean
};

/// A depth picture and the mask of what is foreground, row by row with `pitch_px` columns.
struct MaskedDepth {
    std::span<const float> depth_m;      ///< 0 = none
    std::span<const std::uint8_t> mask;  ///< not 0 on the foreground
    Intrinsics intrinsics{};
    int pitch_px = 0;
};

/// Where the foreground is bulkiest: the middle of the largest circle in it; nothing where it is empty.
std::optional<ForegroundView> view_foreground(const MaskedDepth& picture, float cell_m);

}  // namespace touchstone
