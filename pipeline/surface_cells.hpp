#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "pipeline/brick_neighbourhood.hpp"

namespace touchstone {

/// The crossed edges of the voxel grid that start in one brick, numbered in order. An edge belongs to the
/// voxel it starts from: edge = 3 voxel + axis.
struct BrickEdges {
    static constexpr std::size_t count = std::size_t{3} * BRICK_VOXELS;

    std::array<std::uint64_t, count / 64> crossed{};
    std::array<std::uint32_t, count / 64> first{};  ///< number of each word's first crossed edge

    void mark(std::size_t edge) { crossed[edge / 64] |= std::uint64_t{1} << edge % 64; }
    bool is_crossed(std::size_t edge) const { return (crossed[edge / 64] >> edge % 64 & 1) != 0; }
    std::uint32_t number(std::size_t edge) const {
        const std::uint64_t before = crossed[edge / 64] & ((std::uint64_t{1} << edge % 64) - 1);
        return first[edge / 64] + static_cast<std::uint32_t>(std::popcount(before));
    }
};

/// A cell between known voxels that the surface passes through.
struct SurfaceCell {
    std::uint16_t voxel = 0;  ///< of its corner 0, in the brick: (z 8 + y) 8 + x
    std::uint8_t inside = 0;  ///< as cell_case() takes it
};

/// Where the surface is: cells of each brick and their crossed edges, numbered over the whole volume.
struct SurfaceCells {
    std::vector<SurfaceCell> cells;
    std::vector<std::size_t> first_cell;  ///< of each brick, and one more: the number of cells
    std::vector<BrickEdges> edges;        ///< of each brick
    std::uint32_t edge_count = 0;
};

/// Edge `cell_edge` (of cell_edges) of the cell at x, y, z: the slot of its brick and its number there.
struct EdgeAddress {
    std::size_t slot = 0, edge = 0;
};
EdgeAddress edge_address(const BrickNeighbourhood& around, const SurfaceCell& cell, std::size_t cell_edge);

SurfaceCells find_surface_cells(const VolumeSnapshot& snapshot, const BrickLookup& lookup, int min_weight);

}  // namespace touchstone
