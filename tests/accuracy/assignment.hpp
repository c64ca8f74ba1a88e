#pragma once

#include <cstddef>
#include <vector>

namespace touchstone {

/// Rows of equal length.
using CostMatrix = std::vector<std::vector<double>>;

struct AssignedPair {
    std::size_t row = 0;
    std::size_t column = 0;
};

/// The assignment of least total cost (Kuhn 1955): min(rows, columns) pairs, each row and column once, by
/// row.
std::vector<AssignedPair> least_cost_assignment(const CostMatrix& costs);

}  // namespace touchstone
