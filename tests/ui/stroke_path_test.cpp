#include "ui/stroke_path.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using Eigen::Vector2f;

float turn_rad(const Vector2f& before, const Vector2f& after) {
    const float cross = before.x() * after.y() - before.y() * after.x();
    return std::abs(std::atan2(cross, before.dot(after)));
}

TEST(StrokePath, TapIsOneDot) {
    std::vector<StrokePiece> pieces;
    StrokePath path({10.f, 20.f}, pieces);
    path.move({10.f, 20.f}, pieces);
    path.finish(pieces);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_EQ(pieces[0].a_px, Vector2f(10.f, 20.f));
    EXPECT_EQ(pieces[0].b_px, Vector2f(10.f, 20.f));
}

TEST(StrokePath, FingerAtRestAddsNothing) {
    std::vector<StrokePiece> pieces;
    StrokePath path({10.f, 20.f}, pieces);
    for (int i = 0; i < 100; ++i) path.move({10.1f, 20.f}, pieces);
    EXPECT_EQ(pieces.size(), 1U);
}

TEST(StrokePath, StraightMoveIsAConnectedLineFromStartToEnd) {
    std::vector<StrokePiece> pieces;
    StrokePath path({0.f, 5.f}, pieces);
    for (int i = 1; i <= 4; ++i) path.move({static_cast<float>(10 * i), 5.f}, pieces);
    path.move({47.f, 5.f}, pieces);
    path.finish(pieces);
    Vector2f end(0.f, 5.f);
    for (const StrokePiece& piece : pieces) {
        EXPECT_LT((piece.a_px - end).norm(), 1e-4f);
        EXPECT_NEAR(piece.b_px.y(), 5.f, 1e-4f);
        EXPECT_GE(piece.b_px.x(), piece.a_px.x());
        end = piece.b_px;
    }
    EXPECT_LT((end - Vector2f(47.f, 5.f)).norm(), 1e-4f);
}

TEST(StrokePath, CornersAreRounded) {
    std::vector<StrokePiece> pieces;
    StrokePath path({0.f, 0.f}, pieces);
    path.move({30.f, 0.f}, pieces);
    path.move({30.f, 30.f}, pieces);  // a right angle
    path.move({30.f, 60.f}, pieces);
    path.finish(pieces);
    float sharpest_rad = 0.f;
    for (std::size_t i = 2; i < pieces.size(); ++i)
        sharpest_rad = std::max(
            sharpest_rad, turn_rad(pieces[i - 1].b_px - pieces[i - 1].a_px, pieces[i].b_px - pieces[i].a_px));
    EXPECT_LT(sharpest_rad, 0.4f) << "radians between pieces of a stroke round a corner of 1.57";
    EXPECT_GT(sharpest_rad, 0.01f) << "the stroke does turn";
}

TEST(StrokePath, AFastFingerMakesBoundedWork) {
    std::vector<StrokePiece> pieces;
    StrokePath path({0.f, 0.f}, pieces);
    path.move({1e6f, 0.f}, pieces);
    EXPECT_LE(pieces.size(), 65U);
}

}  // namespace
}  // namespace touchstone
