#include "tests/accuracy/baselines/point_tracker.hpp"

#include <gtest/gtest.h>

namespace touchstone::baselines {
namespace {

using Ids = std::vector<int>;

TEST(PointTracker, KeepsTheIdWithinTheGate) {
    PointTracker tracker(10.0, 0);
    EXPECT_EQ(tracker.follow({{100, 100}}), Ids{1});
    EXPECT_EQ(tracker.follow({{110, 100}}), Ids{1});
    EXPECT_EQ(tracker.follow({{120.5, 100}}), Ids{2});
}

TEST(PointTracker, TheNearestPairGoesFirst) {
    PointTracker tracker(30.0, 0);
    EXPECT_EQ(tracker.follow({{0, 0}, {20, 0}}), (Ids{1, 2}));
    EXPECT_EQ(tracker.follow({{18, 0}, {40, 0}}), (Ids{2, 3})) << "40 is 40 from the point that is left";
}

TEST(PointTracker, RemembersMissingPointsForItsTime) {
    for (const int away : {3, 4}) {
        PointTracker tracker(10.0, 3);
        tracker.follow({{5, 5}});
        for (int i = 0; i < away; ++i) tracker.follow({});
        EXPECT_EQ(tracker.knows(1), away == 3);
        EXPECT_EQ(tracker.follow({{6, 5}}), Ids{away == 3 ? 1 : 2});
    }
}

TEST(PointTracker, TouchesCarryIdAndPixel) {
    PointTracker tracker(10.0, 0);
    const auto touches = follow(tracker, {{3, 4}});
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_EQ(touches.front().id, 1);
    EXPECT_EQ(touches.front().pixel_px, Eigen::Vector2d(3, 4));
}

}  // namespace
}  // namespace touchstone::baselines
