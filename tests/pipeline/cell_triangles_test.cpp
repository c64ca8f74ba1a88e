#include "pipeline/cell_triangles.hpp"

#include <gtest/gtest.h>
#include <set>

namespace touchstone {
namespace {

TEST(CellTriangles, UseCrossedEdgesOnlyAndNoSideTwice) {
    for (int inside = 0; inside < 256; ++inside) {
        const CellCase& found = cell_case(static_cast<std::uint8_t>(inside));
        const CellCase& opposite = cell_case(static_cast<std::uint8_t>(~inside));
        EXPECT_EQ(found.crossed, opposite.crossed);
        EXPECT_EQ(found.triangle_count == 0, inside == 0 || inside == 255);
        std::set<std::pair<int, int>> sides;
        for (std::size_t t = 0; t < found.triangle_count; ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = found.triangles[t][k], b = found.triangles[t][(k + 1) % 3];
                EXPECT_TRUE((found.crossed >> a & 1) != 0);
                EXPECT_TRUE(sides.insert({a, b}).second) << inside;
            }
        }
    }
}

}  // namespace
}  // namespace touchstone
