#pragma once

#include <array>
#include <cstdint>

namespace touchstone {

/// A cell is the cube between eight voxel samples. Corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1).
/// An edge runs along `axis` from corner `corner` to corner `corner | 1 << axis`.
struct CellEdge {
    int corner = 0;
    int axis = 0;
};

inline constexpr std::array<CellEdge, 12> cell_edges = {
    {{0, 0}, {2, 0}, {4, 0}, {6, 0}, {0, 1}, {1, 1}, {4, 1}, {5, 1}, {0, 2}, {1, 2}, {2, 2}, {3, 2}}};

/// Edges of one triangle's vertices, counter-clockwise seen from outside the solid.
using EdgeTriangle = std::array<std::uint8_t, 3>;

struct CellCase {
    std::uint16_t crossed = 0;  ///< bit e: edge e has one end inside and one outside
    std::uint8_t triangle_count = 0;
    std::array<EdgeTriangle, 5> triangles{};
};

/// Surface in a cell by which corners are inside (bit c: corner c). Crossings are joined face by face, two
/// diagonal corners inside always connected, so that both cells at a face agree; no triangle side lies in a
/// face but these joins. Hence every triangle side has exactly one other, turned round, in the cell or in its
/// neighbour: no cracks, no doubled sides. Worked out at the first call; method of Lorensen and Cline 1987
/// with the one choice on ambiguous faces that, for example, Montani, Scateni and Scopigno 1994 make.
const CellCase& cell_case(std::uint8_t inside);

}  // namespace touchstone
