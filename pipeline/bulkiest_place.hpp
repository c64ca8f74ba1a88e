#pragma once

#include <cstdint>
#include <span>

namespace touchstone {

struct GridPlace {
    int x = -1, y = -1;
    float radius_cells = 0.0f;  ///< of the largest circle about it; 0 where the mask is empty
};

/// The middle of the cells of a mask (not 0 = in it; row by row) that are about the farthest from its border,
/// the picture's border included; by chamfer distances, exact to 8 %.
GridPlace bulkiest_place(std::span<const std::uint8_t> mask, int width, int height);

}  // namespace touchstone
