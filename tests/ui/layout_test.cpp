#include "ui/layout.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

constexpr PixelSize depth_picture{640, 480};

bool apart(const DisplayRect& a, const DisplayRect& b) {
    return (a.max_px.array() <= b.min_px.array()).any() || (b.max_px.array() <= a.min_px.array()).any();
}

TEST(Layout, ViewAndPanelLieApartInsideTheDisplayInEverySize) {
    for (const PixelSize size :
         {PixelSize{1280, 720}, {1920, 1080}, {1024, 768}, {720, 1280}, {3840, 1080}, {480, 320}}) {
        const Layout layout = make_layout(size, depth_picture);
        const Eigen::Vector2f view = layout.view.rect.size_px();
        EXPECT_NEAR(view.x() / view.y(), 4.f / 3.f, 1e-3f);
        EXPECT_TRUE(apart(layout.view.rect, layout.panel)) << size.width_px;
        for (const DisplayRect& rect : {layout.view.rect, layout.panel}) {
            EXPECT_GE(rect.min_px.minCoeff(), 0.f) << size.width_px;
            EXPECT_LE(rect.max_px.x(), static_cast<float>(size.width_px)) << size.width_px;
            EXPECT_LE(rect.max_px.y(), static_cast<float>(size.height_px)) << size.width_px;
        }
    }
}

TEST(Layout, PanelStandsBesideOnWideDisplaysOnly) {
    EXPECT_TRUE(make_layout({1280, 720}, depth_picture).panel_beside);
    EXPECT_TRUE(make_layout({1920, 1080}, depth_picture).panel_beside);
    EXPECT_FALSE(make_layout({1024, 768}, depth_picture).panel_beside);
    EXPECT_FALSE(make_layout({1280, 720}, {1280, 720}).panel_beside);
}

TEST(Layout, AProjectedViewTakesAllOfTheDisplay) {
    const Layout layout = make_projected_layout({600, 400}, {600, 400});
    EXPECT_EQ(layout.view.rect.min_px, Eigen::Vector2f(0.f, 0.f));
    EXPECT_EQ(layout.view.rect.max_px, Eigen::Vector2f(600.f, 400.f));
    EXPECT_FLOAT_EQ(layout.view.display_px_per_px, 1.f);
    EXPECT_LT(layout.panel.max_px.x(), 300.f);
}

TEST(Layout, TypeGrowsWithTheDisplay) {
    EXPECT_FLOAT_EQ(make_layout({1280, 720}, depth_picture).scale, 1.f);
    EXPECT_FLOAT_EQ(make_layout({1920, 1080}, depth_picture).scale, 1.5f);
}

}  // namespace
}  // namespace touchstone
