// The part of the view in which things that are drawn may lie.
#include "ui/surface_room.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

using Eigen::AlignedBox2f;
using Eigen::Vector2f;

const AlignedBox2f view(Vector2f(0.f, 0.f), Vector2f(639.f, 479.f));
/// Narrow above; its left foot is beyond the view.
const std::array<Vector2f, 4> trapezoid{Vector2f(200.f, 100.f), Vector2f(440.f, 100.f),
                                        Vector2f(540.f, 400.f), Vector2f(-100.f, 400.f)};

TEST(SurfaceRoom, ItsSpanIsThatOfTheAreaWithinTheView) {
    const SurfaceRoom room(trapezoid, view);
    EXPECT_TRUE(room.box_px().isApprox(AlignedBox2f(Vector2f(0.f, 100.f), Vector2f(540.f, 400.f))));
    ASSERT_TRUE(room.span_px(250.f));
    EXPECT_TRUE(room.span_px(250.f)->isApprox(Vector2f(50.f, 490.f)));
    EXPECT_TRUE(room.span_px(399.f)->isApprox(Vector2f(0.f, 540.f), 1e-2f)) << "the view ends there";
    EXPECT_FALSE(room.span_px(99.f));
    EXPECT_FALSE(room.span_px(401.f));
}

TEST(SurfaceRoom, ABoxIsMovedUntilItIsInside) {
    const SurfaceRoom room(trapezoid, view);
    const Vector2f half(30.f, 20.f), inside(300.f, 250.f);
    EXPECT_EQ(room.nearest_px(inside, half), inside);
    const Vector2f right = room.nearest_px({600.f, 250.f}, half);
    EXPECT_FLOAT_EQ(right.y(), 250.f);
    EXPECT_NEAR(right.x() + half.x(), room.span_px(250.f - half.y())->y(), 1e-3f) << "at its upper corner";
    const Vector2f foot = room.nearest_px({-50.f, 500.f}, half);
    EXPECT_FLOAT_EQ(foot.y(), 380.f);
    EXPECT_NEAR(foot.x() - half.x(), room.span_px(360.f)->x(), 1e-3f);
    const Vector2f top = room.nearest_px({0.f, 0.f}, half);
    EXPECT_NEAR(top.y(), 120.f, 1e-3f);
    EXPECT_NEAR(top.x(), 230.f, 0.05f);
}

TEST(SurfaceRoom, WhatIsTooLargeLiesInTheMiddle) {
    const SurfaceRoom room(trapezoid, view);
    EXPECT_NEAR(room.nearest_px({0.f, 0.f}, {150.f, 20.f}).x(), 320.f, 0.1f) << "as wide as the top and more";
    EXPECT_FLOAT_EQ(room.nearest_px({0.f, 0.f}, {10.f, 200.f}).y(), 250.f);
}

TEST(SurfaceRoom, WithoutAnAreaInTheViewItIsTheView) {
    const std::array<Vector2f, 4> beyond{Vector2f(900.f, 0.f), Vector2f(950.f, 0.f), Vector2f(950.f, 50.f),
                                         Vector2f(900.f, 50.f)};
    for (const SurfaceRoom& room : {SurfaceRoom(view), SurfaceRoom(beyond, view)}) {
        EXPECT_TRUE(room.box_px().isApprox(view));
        EXPECT_TRUE(room.span_px(200.f)->isApprox(Vector2f(0.f, 639.f)));
    }
}

}  // namespace
}  // namespace touchstone
