#include "tests/accuracy/assignment.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace touchstone {
namespace {

CostMatrix transposed(const CostMatrix& costs) {
    CostMatrix turned(costs.front().size(), std::vector<double>(costs.size()));
    for (std::size_t r = 0; r < costs.size(); ++r) {
        for (std::size_t c = 0; c < costs[r].size(); ++c) turned[c][r] = costs[r][c];
    }
    return turned;
}

/// Rows are added one by one; each finds the cheapest path of changes (Dijkstra over reduced costs) to a free
/// column. Columns are counted from 1: column 0 stands for the row that is being added. Needs rows <=
/// columns.
class Matching {
  public:
    explicit Matching(const CostMatrix& costs)
        : costs_(costs),
          row_price_(costs.size() + 1),
          column_price_(costs.front().size() + 1),
          row_of_(costs.front().size() + 1) {}

    void add_row(std::size_t row) {
        row_of_[0] = row;
        std::vector<double> distance(row_of_.size(), std::numeric_limits<double>::infinity());
        std::vector<std::size_t> before(row_of_.size());
        std::vector<bool> done(row_of_.size());
        std::size_t column = 0;
        do {
            done[column] = true;
            column = step(column, distance, before, done);
        } while (row_of_[column] != 0);
        for (; column != 0; column = before[column]) row_of_[column] = row_of_[before[column]];
    }

    /// Row of each column, both from 1; 0 where it is free.
    const std::vector<std::size_t>& row_of() const { return row_of_; }

  private:
    std::size_t step(std::size_t from, std::vector<double>& distance, std::vector<std::size_t>& before,
                     const std::vector<bool>& done) {
        const std::size_t row = row_of_[from];
        std::size_t nearest = 0;
        double delta = std::numeric_limits<double>::infinity();
        for (std::size_t c = 1; c < row_of_.size(); ++c) {
            if (done[c]) continue;
            const double reduced = costs_[row - 1][c - 1] - row_price_[row] - column_price_[c];
            if (reduced < distance[c]) {
                distance[c] = reduced;
                before[c] = from;
            }
            if (distance[c] < delta) {
                delta = distance[c];
                nearest = c;
            }
        }
        for (std::size_t c = 0; c < row_of_.size(); ++c) {
            if (done[c]) {
                row_price_[row_of_[c]] += delta;
                column_price_[c] -= delta;
            } else {
                distance[c] -= delta;
            }
        }
        return nearest;
    }

    const CostMatrix& costs_;
    std::vector<double> row_price_, column_price_;
    std::vector<std::size_t> row_of_;
};

}  // namespace

std::vector<AssignedPair> least_cost_assignment(const CostMatrix& costs) {
    if (costs.empty() || costs.front().empty()) return {};
    const bool turn = costs.size() > costs.front().size();
    const CostMatrix wide = turn ? transposed(costs) : costs;
    Matching matching(wide);
    for (std::size_t row = 1; row <= wide.size(); ++row) matching.add_row(row);
    std::vector<AssignedPair> pairs;
    for (std::size_t c = 1; c < matching.row_of().size(); ++c) {
        const std::size_t row = matching.row_of()[c];
        if (row == 0) continue;
        pairs.push_back(turn ? AssignedPair{c - 1, row - 1} : AssignedPair{row - 1, c - 1});
    }
    std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.row < b.row; });
    return pairs;
}

}  // namespace touchstone
