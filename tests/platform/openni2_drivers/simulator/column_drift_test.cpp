#include "platform/openni2_drivers/simulator/column_drift.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace touchstone::sim {
namespace {

TEST(ColumnDrift, StartsCalibratedStaysInBoundsAndMovesSlowly) {
    ColumnDrift drift(3, 640);
    std::vector<float> before = drift.at(0.0);
    EXPECT_EQ(before, std::vector<float>(640, 0.0F));
    int still_frames = 0;
    float most = 0.0F;
    for (int frame = 1; frame < 3600; ++frame) {
        const std::vector<float>& now = drift.at(frame / 30.0);
        float change = 0.0F;
        for (std::size_t x = 0; x < 640; ++x) {
            change = std::max(change, std::abs(now[x] - before[x]));
            most = std::max(most, std::abs(now[x]));
        }
        // A change of at most 2 steps over 100 frames is nowhere faster than 1.9 times its mean.
        EXPECT_LT(change, 0.04F);
        still_frames += change == 0.0F;
        before = now;
    }
    EXPECT_LE(most, 2.0001F);
    EXPECT_GT(most, 0.5F);
    EXPECT_GT(still_frames, 1800) << "it stands still most of the time";
}

TEST(ColumnDrift, ColumnsMoveInBands) {
    ColumnDrift drift(4, 640);
    const std::vector<float> now = drift.at(18.5);
    const std::set<float> offsets(now.begin(), now.end());
    EXPECT_GE(offsets.size(), 5U);
    EXPECT_LE(offsets.size(), 17U);
    int steps = 0;
    for (std::size_t x = 1; x < 640; ++x) steps += now[x] != now[x - 1];
    EXPECT_EQ(static_cast<std::size_t>(steps) + 1, offsets.size());
}

}  // namespace
}  // namespace touchstone::sim
