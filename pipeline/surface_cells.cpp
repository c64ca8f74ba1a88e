#include "pipeline/surface_cells.hpp"

#include "pipeline/cell_triangles.hpp"

namespace touchstone {
namespace {

enum VoxelState : std::uint8_t { OUTSIDE = 0, INSIDE = 1, UNKNOWN = 2 };

VoxelState state_of(std::int32_t voxel, int min_weight) {
    if (voxel_weight(voxel) < min_weight) return UNKNOWN;
    return voxel_tsdf(voxel) <= 0 ? INSIDE : OUTSIDE;
}

/// A brick's voxels and the first layers of the next bricks: corners of all its cells.
struct BrickStates {
    static constexpr int side = BRICK_VOX + 1;
    std::array<VoxelState, std::size_t{side} * side * side> states{};
    bool has_inside = false, has_outside = false;

    VoxelState at(int x, int y, int z) const {
        return states[static_cast<std::size_t>((z * side + y) * side + x)];
    }
};

BrickStates states_of(const VolumeSnapshot& snapshot, const BrickNeighbourhood& around, int min_weight) {
    BrickStates result;
    std::size_t i = 0;
    for (int z = 0; z < BrickStates::side; ++z) {
        for (int y = 0; y < BrickStates::side; ++y) {
            for (int x = 0; x < BrickStates::side; ++x) {
                const std::size_t index = around.index(x, y, z);
                const bool absent = index == BrickNeighbourhood::absent;
                const VoxelState state = absent ? UNKNOWN : state_of(snapshot.voxels[index], min_weight);
                result.has_inside |= state == INSIDE;
                result.has_outside |= state == OUTSIDE;
                result.states[i++] = state;
            }
        }
    }
    return result;
}

/// Corners inside, as cell_case() takes them; 0 where one is unknown.
std::uint8_t inside_corners(const BrickStates& states, int x, int y, int z) {
    int inside = 0, unknown = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int state = states.at(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
        inside |= (state & INSIDE) << corner;
        unknown |= state & UNKNOWN;
    }
    return static_cast<std::uint8_t>(unknown != 0 ? 0 : inside);
}

void add_cells(const BrickStates& states, std::vector<SurfaceCell>& cells) {
    for (int voxel = 0; voxel < BRICK_VOXELS; ++voxel) {
        const std::uint8_t inside = inside_corners(states, voxel & 7, voxel >> 3 & 7, voxel >> 6);
        if (inside != 0 && inside != 255) cells.push_back({static_cast<std::uint16_t>(voxel), inside});
    }
}

void mark_edges(SurfaceCells& surface, const BrickNeighbourhood& around, const SurfaceCell& cell) {
    const std::uint16_t crossed = cell_case(cell.inside).crossed;
    for (std::size_t e = 0; e < cell_edges.size(); ++e) {
        if ((crossed >> e & 1) == 0) continue;
        const EdgeAddress address = edge_address(around, cell, e);
        surface.edges[address.slot].mark(address.edge);
    }
}

void number_edges(SurfaceCells& surface) {
    for (BrickEdges& edges : surface.edges) {
        for (std::size_t word = 0; word < edges.first.size(); ++word) {
            edges.first[word] = surface.edge_count;
            surface.edge_count += static_cast<std::uint32_t>(std::popcount(edges.crossed[word]));
        }
    }
}

}  // namespace

EdgeAddress edge_address(const BrickNeighbourhood& around, const SurfaceCell& cell, std::size_t cell_edge) {
    const CellEdge& edge = cell_edges[cell_edge];
    const int x = (cell.voxel & 7) + (edge.corner & 1), y = (cell.voxel >> 3 & 7) + (edge.corner >> 1 & 1);
    const int z = (cell.voxel >> 6) + (edge.corner >> 2);
    const std::size_t index = around.index(x, y, z);  // present: all corners of a surface cell are
    return {index / BRICK_VOXELS, index % BRICK_VOXELS * 3 + static_cast<std::size_t>(edge.axis)};
}

SurfaceCells find_surface_cells(const VolumeSnapshot& snapshot, const BrickLookup& lookup, int min_weight) {
    SurfaceCells surface;
    surface.edges.resize(snapshot.bricks.size());
    for (const int brick : snapshot.bricks) {
        const BrickNeighbourhood around(lookup, brick_place(brick, lookup.bricks_per_side()));
        const BrickStates states = states_of(snapshot, around, min_weight);
        const std::size_t first = surface.cells.size();
        surface.first_cell.push_back(first);
        if (!states.has_inside || !states.has_outside) continue;
        add_cells(states, surface.cells);
        for (std::size_t i = first; i < surface.cells.size(); ++i)
            mark_edges(surface, around, surface.cells[i]);
    }
    surface.first_cell.push_back(surface.cells.size());
    number_edges(surface);
    return surface;
}

}  // namespace touchstone
