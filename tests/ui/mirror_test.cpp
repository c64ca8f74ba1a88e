// The scene with the mirror ball and the model: what it wishes to see when fingers drag, stretch and turn.
#include "ui/scenes/mirror.hpp"

#include "scene_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

class MirrorTest : public SceneFixture {
  protected:
    MirrorTest() { open("mirror"); }

    ViewWish wish() const {
        const auto view = presenter_->wish().view;
        EXPECT_TRUE(view && view->sphere && view->mesh);
        return *view;
    }
    MirrorSphere ball() const { return *wish().sphere; }
    Vector2f ball_px() const { return pixel_of(ball().centre_g_m); }
    /// Middle and rows of the pixels that the model covers.
    struct Shape {
        Vector2f middle_px{0.f, 0.f};
        int pixels = 0;
    };
    Shape model() const {
        const auto mesh = wish().mesh;
        Shape shape;
        for (int y = 0; y < 240; ++y) {
            for (int x = 0; x < 320; ++x) {
                if (mesh->depth_m[static_cast<std::size_t>(y * 320 + x)] == 0.f) continue;
                shape.middle_px += Vector2f(static_cast<float>(x), static_cast<float>(y));
                ++shape.pixels;
            }
        }
        shape.middle_px /= static_cast<float>(std::max(shape.pixels, 1));
        return shape;
    }
    /// Two fingers about a place, as far apart as given, at an angle.
    void pinch(Vector2f about, float from_px, float to_px, float turn_rad) {
        const auto at = [&](float share, float side) {
            const float reach = 0.5f * (from_px + share * (to_px - from_px)), angle = share * turn_rad;
            return Vector2f(about + side * reach * Vector2f(std::cos(angle), std::sin(angle)));
        };
        present({touch(1, TouchPhase::down, at(0.f, 1.f)), touch(2, TouchPhase::down, at(0.f, -1.f))});
        for (int i = 1; i <= 12; ++i) {
            const float share = static_cast<float>(i) / 12.f;
            present(
                {touch(1, TouchPhase::move, at(share, 1.f)), touch(2, TouchPhase::move, at(share, -1.f))});
        }
        present({touch(1, TouchPhase::up, at(1.f, 1.f)), touch(2, TouchPhase::up, at(1.f, -1.f))});
        pass(0.3f);
    }
};

TEST_F(MirrorTest, OverTheCamerasOwnPictureOnlyWhatIsVirtualIsWished) {
    EXPECT_EQ(wish().style, ViewStyle::shaded);
    const int version = wish().version;
    frame_.view_is_camera = true;
    present({});
    EXPECT_EQ(wish().style, ViewStyle::over_camera);
    EXPECT_GT(wish().version, version) << "the picture is another";
    frame_.view_is_camera = false;
    present({});
    EXPECT_EQ(wish().style, ViewStyle::shaded);
}

/// The table is at 1.1 m and faces the camera: a ball of 60 mm stands 60 mm before it.
TEST_F(MirrorTest, BallAndModelStandOnTheTable) {
    EXPECT_FALSE(wish().T_g_v.has_value()) << "from the camera's own pose";
    EXPECT_NEAR(ball().radius_m, 0.06f, 1e-5f);
    EXPECT_NEAR(ball().centre_g_m.z(), table_m - 0.06f, 1e-4f);
    const Shape shape = model();
    EXPECT_GT(shape.pixels, 200);
    EXPECT_GT(shape.middle_px.x(), ball_px().x() + 30.f) << "to the right of the ball";
    const auto depth = wish().mesh->depth_m;
    const float nearest = *std::ranges::min_element(depth, {}, [](float d) { return d == 0.f ? 9.f : d; });
    EXPECT_NEAR(nearest, table_m - 0.17f, 0.002f) << "17 cm high";
}

TEST_F(MirrorTest, ADraggedBallStaysUnderTheFingerAndTheModelStays) {
    const Vector2f before = ball_px(), model_before = model().middle_px;
    const int version = wish().version;
    stroke(before, before + Vector2f(-30.f, 40.f), 12);
    // The finger is on the table, the ball's middle nearer: it goes a little further in the picture.
    EXPECT_LT((ball_px() - before - Vector2f(-30.f, 40.f)).norm(), 5.f);
    EXPECT_LT((model().middle_px - model_before).norm(), 0.5f);
    EXPECT_GT(wish().version, version);
}

TEST_F(MirrorTest, AFingerBesideThemMovesNothing) {
    pass(0.3f);
    const ViewWish before = wish();
    stroke({60.f, 60.f}, {100.f, 80.f});
    EXPECT_EQ(wish().version, before.version);
}

TEST_F(MirrorTest, OnSomethingHighTheBallStandsHigher) {
    const Vector2f at = ball_px();
    present({touch(1, TouchPhase::down, at)});
    for (int i = 1; i <= 10; ++i) {
        TouchEvent on_box = touch(1, TouchPhase::move, at + Vector2f(3.f * static_cast<float>(i), 0.f));
        on_box.tip.surface_c_m *= (table_m - 0.1f) / table_m;  // a box of 10 cm
        present({on_box});
    }
    EXPECT_NEAR(ball().centre_g_m.z(), table_m - 0.16f, 1e-3f);
}

TEST_F(MirrorTest, TwoFingersStretchAndTurnTheModel) {
    const Shape before = model();
    pinch(before.middle_px, 24.f, 48.f, 0.f);
    EXPECT_GT(model().pixels, 2 * before.pixels);
    const ViewWish unturned = wish();
    pinch(model().middle_px, 40.f, 40.f, 1.2f);
    EXPECT_NE(wish().mesh->rgba, unturned.mesh->rgba) << "its glaze is not the same all around";
    EXPECT_NEAR(model().pixels, static_cast<float>(2 * before.pixels),
                3.f * static_cast<float>(before.pixels));
    pinch(model().middle_px, 10.f, 200.f, 0.f);
    const auto depth = wish().mesh->depth_m;
    const float nearest = *std::ranges::min_element(depth, {}, [](float d) { return d == 0.f ? 9.f : d; });
    EXPECT_GT(nearest, table_m - 0.41f) << "it never grows beyond 40 cm";
}

TEST_F(MirrorTest, NothingLeavesTheArea) {
    stroke(ball_px(), {2.f, 120.f}, 20);
    EXPECT_GE(ball().centre_g_m.x(), -0.551f);
}

TEST_F(MirrorTest, MovesWhileDraggedAndRestsAfterwards) {
    pass(0.5f);
    EXPECT_FALSE(wish().moving);
    const Vector2f at = ball_px();
    present({touch(1, TouchPhase::down, at)});
    for (int i = 1; i < 8; ++i)
        present({touch(1, TouchPhase::move, at + Vector2f(4.f * static_cast<float>(i), 0.f))});
    EXPECT_TRUE(wish().moving);
    present({touch(1, TouchPhase::up, at + Vector2f(28.f, 0.f))});
    pass(0.5f);
    EXPECT_FALSE(wish().moving);
}

TEST_F(MirrorTest, TheButtonPutsThemBack) {
    const Vector2f before = ball_px();
    stroke(before, before + Vector2f(40.f, 30.f));
    const SurfaceGeometry surface(frame_, view_size);
    tap(surface.bottom_row(20.f).center());
    pass(0.1f);
    EXPECT_LT((ball_px() - before).norm(), 0.1f);
}

TEST_F(MirrorTest, AKnockedCameraSeesThemWhereTheyStand) {
    const Vector3f stood = ball().centre_g_m;
    const Vector2f model_px = model().middle_px;
    frame_.T_g_c.translation() = Vector3f(0.05f, 0.f, 0.f);
    present();
    EXPECT_LT((ball().centre_g_m - stood).norm(), 1e-5f);
    EXPECT_NEAR(model().middle_px.x(), model_px.x() - 0.05f * 290.f / 1.02f, 2.f);
}

/// Of wishes of one version only the first is rendered: another pose is another picture of the model.
TEST_F(MirrorTest, AKnockIsANewWishOnceAndAStillCameraNone) {
    pass(0.5f);
    const ViewWish before = wish();
    pass(0.2f);
    EXPECT_EQ(wish().version, before.version);
    frame_.T_g_c.translation() = Vector3f(0.05f, 0.f, 0.f);
    present();
    const ViewWish after = wish();
    EXPECT_GT(after.version, before.version);
    EXPECT_NE(after.mesh->depth_m, before.mesh->depth_m);
    pass(0.5f);
    EXPECT_EQ(wish().version, after.version);
    EXPECT_FALSE(wish().moving);
}

TEST_F(MirrorTest, WhatIsRenderedLiesOverTheTable) {
    auto rendered = std::make_shared<RenderedView>();
    rendered->picture = {view_size.width_px, view_size.height_px,
                         std::vector<std::uint8_t>(std::size_t{4} * 320 * 240, 0)};
    const std::size_t byte = 4 * (100 * 320 + 80);
    for (int dy = 0; dy < 3; ++dy)
        for (int dx = 0; dx < 3; ++dx)
            for (const std::size_t channel : {0U, 3U})
                rendered->picture.rgba[byte + 4 * static_cast<std::size_t>(320 * dy + dx) + channel] = 255;
    frame_.rendered = rendered;
    present();
    const Picture picture = present();
    EXPECT_NEAR(color_at_view(picture, {81.f, 101.f}).g, 0, tolerance);
    EXPECT_NEAR(color_at_view(picture, {91.f, 101.f}).g, 255, tolerance) << "alpha 0 shows the table";
}

}  // namespace
}  // namespace touchstone
