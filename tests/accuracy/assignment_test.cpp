#include "tests/accuracy/assignment.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <set>

namespace touchstone {
namespace {

double total(const CostMatrix& costs, const std::vector<AssignedPair>& pairs) {
    return std::accumulate(pairs.begin(), pairs.end(), 0.0, [&](double sum, const AssignedPair& pair) {
        return sum + costs[pair.row][pair.column];
    });
}

/// The least total over all ways to give each row a column. Needs rows <= columns.
double least_total(const CostMatrix& costs) {
    std::vector<std::size_t> columns(costs.front().size());
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    double least = 1e300;
    do {
        double sum = 0.0;
        for (std::size_t row = 0; row < costs.size(); ++row) sum += costs[row][columns[row]];
        least = std::min(least, sum);
    } while (std::next_permutation(columns.begin(), columns.end()));
    return least;
}

TEST(Assignment, PrefersTheLeastTotalToTheNearestPair) {
    const auto pairs = least_cost_assignment({{1.0, 2.0}, {2.0, 100.0}});
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_EQ(pairs[0].column, 1u);
    EXPECT_EQ(pairs[1].column, 0u);
}

TEST(Assignment, OfNothingIsEmpty) {
    EXPECT_TRUE(least_cost_assignment({}).empty());
    EXPECT_TRUE(least_cost_assignment({{}, {}}).empty());
}

TEST(Assignment, EqualsTheBestOfAllPermutations) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> cost(0.0, 50.0);
    for (int round = 0; round < 300; ++round) {
        const std::size_t rows = 1 + random() % 5;
        const std::size_t columns = rows + random() % 3;
        CostMatrix costs(rows, std::vector<double>(columns));
        for (auto& row : costs) {
            for (double& value : row) value = cost(random) > 25.0 ? 1e6 : cost(random);
        }
        const auto pairs = least_cost_assignment(costs);
        std::set<std::size_t> used;
        for (const auto& pair : pairs) used.insert(pair.column);
        EXPECT_EQ(used.size(), rows);
        EXPECT_NEAR(total(costs, pairs), least_total(costs), 1e-6);
    }
}

TEST(Assignment, OfATallMatrixIsThatOfItsTranspose) {
    const auto pairs = least_cost_assignment({{5.0}, {1.0}, {3.0}});
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].row, 1u);
    EXPECT_EQ(pairs[0].column, 0u);
}

}  // namespace
}  // namespace touchstone
