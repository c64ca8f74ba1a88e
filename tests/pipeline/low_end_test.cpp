#include "pipeline/low_end.hpp"

#include <gtest/gtest.h>

#include "tests/support/finger_scene.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

class LowEndFloods : public testing::Test {
  protected:
    /// A block of foreground, `lifted_m` over the table.
    void add_block(int x0, int y0, int x1, int y1, float lifted_m) {
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) scene.live_m[scene.background.index(x, y)] = 1.0f - lifted_m;
    }
    LowEnd flood(int x, int y) {
        scene.finish();
        return LowEndFlood(picture = scene.picture(), {}).from(x, y);
    }
    test::FingerScene scene{test::plane_ground({0.0f, 0.0f, 1.0f}, 1.0f)};
    TablePicture picture;
};

TEST_F(LowEndFloods, TakesAConnectedBlockOnce) {
    add_block(100, 90, 110, 98, 0.03f);
    const LowEnd end = flood(104, 92);
    EXPECT_EQ(end.points_m.size(), 80u);
    EXPECT_EQ(end.pixels_px.size(), 80u);
    EXPECT_NEAR(end.seed_m.z(), 0.97f, 1e-5f);
}

TEST_F(LowEndFloods, StopsAtAStepInDepth) {
    add_block(100, 90, 110, 98, 0.03f);
    add_block(110, 90, 120, 98, 0.06f);
    EXPECT_EQ(flood(104, 92).points_m.size(), 80u);
}

TEST_F(LowEndFloods, BridgesASingleLostColumn) {
    add_block(100, 90, 110, 98, 0.03f);
    for (int y = 90; y < 98; ++y) scene.live_m[scene.background.index(105, y)] = 0.0f;
    EXPECT_EQ(flood(102, 92).points_m.size(), 72u);
}

TEST_F(LowEndFloods, StaysWithinItsRadius) {
    add_block(20, 94, 220, 104, 0.03f);
    for (const Vector3f& p : flood(120, 100).points_m)
        EXPECT_LE((p - Vector3f(0.5f, 0.5f, 0.0f) * 0.97f / 575.8f - Vector3f(0.0f, 0.0f, 0.97f)).norm(),
                  0.0341f);
}

TEST_F(LowEndFloods, WhatIsTooWideForAFingerHasNoPoints) {
    add_block(80, 60, 160, 140, 0.03f);
    EXPECT_TRUE(flood(120, 100).points_m.empty());
}

TEST_F(LowEndFloods, TakesTheLostEdgeBesideTheMaskButDoesNotGrowFromIt) {
    add_block(100, 90, 110, 98, 0.012f);
    add_block(110, 90, 116, 98, 0.0045f);  // lower than the mask's 5 mm
    EXPECT_EQ(flood(104, 92).points_m.size(), 88u);
}

TEST_F(LowEndFloods, WorksAtThePicturesCorner) {
    add_block(0, 0, 6, 6, 0.03f);
    EXPECT_EQ(flood(0, 0).points_m.size(), 36u);
}

}  // namespace
}  // namespace touchstone
