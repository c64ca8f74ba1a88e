#include "pipeline/cell_triangles.hpp"

#include <stdexcept>

namespace touchstone {
namespace {

/// Corners of a face, counter-clockwise seen from outside the cell.
constexpr std::array<int, 4> face_corners(int axis, int side) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, at = side << axis;
    if (side == 1) return {at, at | u, at | u | v, at | v};
    return {at, at | v, at | u | v, at | u};
}

constexpr int edge_between(int a, int b) {
    for (int e = 0; e < 12; ++e) {
        const CellEdge& edge = cell_edges[static_cast<std::size_t>(e)];
        const int other = edge.corner | 1 << edge.axis;
        if ((edge.corner == a && other == b) || (edge.corner == b && other == a)) return e;
    }
    throw std::logic_error("these corners have no edge");
}

/// For each crossed edge the next one around the surface: loops with the outside to the left, seen from
/// outside the cell.
using NextEdge = std::array<int, 12>;

/// A join starts where the walk around the face goes in and ends where it last went out, so that it cuts off
/// the corners outside.
constexpr void join_crossings(NextEdge& next, std::uint8_t inside, const std::array<int, 4>& corners) {
    const auto is_inside = [&](int i) {
        return (inside >> corners[static_cast<std::size_t>(i & 3)] & 1) != 0;
    };
    const auto edge = [&](int i) {
        return edge_between(corners[static_cast<std::size_t>(i & 3)],
                            corners[static_cast<std::size_t>((i + 1) & 3)]);
    };
    for (int entry = 4; entry < 8; ++entry) {
        if (is_inside(entry) || !is_inside(entry + 1)) continue;
        int exit = entry - 1;
        while (!(is_inside(exit) && !is_inside(exit + 1))) --exit;
        next[static_cast<std::size_t>(edge(entry))] = edge(exit);
    }
}

constexpr NextEdge loops_of(std::uint8_t inside) {
    NextEdge next{};
    next.fill(-1);
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) join_crossings(next, inside, face_corners(axis, side));
    }
    return next;
}

/// Middle of an edge in half cell sides.
constexpr std::array<int, 3> middle(int e) {
    const CellEdge& edge = cell_edges[static_cast<std::size_t>(e)];
    std::array<int, 3> p{};
    for (int axis = 0; axis < 3; ++axis) {
        p[static_cast<std::size_t>(axis)] = edge.axis == axis ? 1 : 2 * (edge.corner >> axis & 1);
    }
    return p;
}

constexpr bool share_a_face(int a, int b) {
    const auto p = middle(a), q = middle(b);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (p[axis] == q[axis] && p[axis] != 1) return true;
    }
    return false;
}

constexpr int squared_distance(int a, int b) {
    const auto p = middle(a), q = middle(b);
    int sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) sum += (p[axis] - q[axis]) * (p[axis] - q[axis]);
    return sum;
}

struct Loop {
    std::array<int, 12> edges{};
    int size = 0;

    constexpr int at(int i) const { return edges[static_cast<std::size_t>(i % size)]; }
    constexpr void remove(int i) {
        for (--size; i < size; ++i)
            edges[static_cast<std::size_t>(i)] = edges[static_cast<std::size_t>(i + 1)];
    }
};

constexpr void add_triangle(CellCase& result, int a, int b, int c) {
    result.triangles.at(result.triangle_count++) = {
        static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)};
}

/// Cuts off corner after corner, the shortest new side first, none within a face.
constexpr void fill_loop(CellCase& result, Loop loop) {
    while (loop.size > 3) {
        int best = -1, best_length = 1000;
        for (int i = 0; i < loop.size; ++i) {
            const int before = loop.at(i + loop.size - 1), after = loop.at(i + 1);
            const int length = squared_distance(before, after);
            if (share_a_face(before, after) || length >= best_length) continue;
            best = i;
            best_length = length;
        }
        if (best < 0) throw std::logic_error("a loop cannot be filled");
        add_triangle(result, loop.at(best + loop.size - 1), loop.at(best), loop.at(best + 1));
        loop.remove(best);
    }
    add_triangle(result, loop.at(0), loop.at(1), loop.at(2));
}

constexpr CellCase make_case(std::uint8_t inside) {
    CellCase result;
    NextEdge next = loops_of(inside);
    for (int first = 0; first < 12; ++first) {
        Loop loop;
        for (int e = first; next[static_cast<std::size_t>(e)] >= 0;) {
            loop.edges[static_cast<std::size_t>(loop.size++)] = e;
            result.crossed = static_cast<std::uint16_t>(result.crossed | 1 << e);
            const int following = next[static_cast<std::size_t>(e)];
            next[static_cast<std::size_t>(e)] = -1;
            e = following;
        }
        if (loop.size > 0) fill_loop(result, loop);
    }
    return result;
}

std::array<CellCase, 256> make_cases() {
    std::array<CellCase, 256> cases{};
    for (std::size_t inside = 0; inside < 256; ++inside) {
        cases[inside] = make_case(static_cast<std::uint8_t>(inside));
    }
    return cases;
}

}  // namespace

const CellCase& cell_case(std::uint8_t inside) {
    static const std::array<CellCase, 256> cases = make_cases();
    return cases[inside];
}

}  // namespace touchstone
