#include "ui/view_mapping.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

using Eigen::Vector2f;

TEST(ViewMapping, WideRoomLeavesPillars) {
    const ViewMapping mapping = fit_view({640, 480}, {{0.f, 0.f}, {1280.f, 720.f}});
    EXPECT_FLOAT_EQ(mapping.display_px_per_px, 1.5f);
    EXPECT_TRUE(mapping.rect.min_px.isApprox(Vector2f(160.f, 0.f)));
    EXPECT_TRUE(mapping.rect.max_px.isApprox(Vector2f(1120.f, 720.f)));
}

TEST(ViewMapping, TallRoomLeavesBarsAboveAndBelow) {
    const ViewMapping mapping = fit_view({640, 480}, {{20.f, 100.f}, {340.f, 500.f}});
    EXPECT_FLOAT_EQ(mapping.display_px_per_px, 0.5f);
    EXPECT_TRUE(mapping.rect.min_px.isApprox(Vector2f(20.f, 180.f)));
    EXPECT_TRUE(mapping.rect.max_px.isApprox(Vector2f(340.f, 420.f)));
}

TEST(ViewMapping, CornersOfThePictureAreHalfAPixelBeyondItsPixels) {
    const ViewMapping mapping = fit_view({640, 480}, {{0.f, 0.f}, {1280.f, 960.f}});
    EXPECT_TRUE(mapping.to_display({0.f, 0.f}).isApprox(Vector2f(1.f, 1.f)));
    EXPECT_TRUE(mapping.to_display({639.f, 479.f}).isApprox(Vector2f(1279.f, 959.f)));
    EXPECT_TRUE(mapping.to_display({319.5f, 239.5f}).isApprox(mapping.rect.center_px()));
}

TEST(ViewMapping, BackAndForthIsTheSamePlace) {
    const ViewMapping mapping = fit_view({640, 480}, {{311.f, 28.f}, {1252.f, 692.f}});
    const Vector2f place(123.25f, 417.5f);
    EXPECT_LT((mapping.to_view(mapping.to_display(place)) - place).norm(), 1e-3f);
}

}  // namespace
}  // namespace touchstone
