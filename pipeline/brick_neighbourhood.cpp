#include "pipeline/brick_neighbourhood.hpp"

namespace touchstone {

BrickLookup::BrickLookup(const std::vector<int>& bricks, int bricks_per_side) : side_(bricks_per_side) {
    const auto side = static_cast<std::size_t>(side_);
    slots_.assign(side * side * side, -1);
    for (std::size_t slot = 0; slot < bricks.size(); ++slot) {
        slots_.at(static_cast<std::size_t>(bricks[slot])) = static_cast<int>(slot);
    }
}

int BrickLookup::slot(const std::array<int, 3>& brick) const {
    for (const int place : brick) {
        if (place < 0 || place >= side_) return -1;
    }
    return slots_[static_cast<std::size_t>((brick[2] * side_ + brick[1]) * side_ + brick[0])];
}

BrickNeighbourhood::BrickNeighbourhood(const BrickLookup& lookup, const std::array<int, 3>& brick) {
    std::size_t i = 0;
    for (int z = -1; z <= 1; ++z) {
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                slots_[i++] = lookup.slot({brick[0] + x, brick[1] + y, brick[2] + z});
            }
        }
    }
}

}  // namespace touchstone
