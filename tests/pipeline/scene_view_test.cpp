// The scene of lit_scene.hpp, a camera that looks into it, and a hand of 30 x 20 pixels in the middle of its
// picture.
#include "pipeline/scene_view.hpp"

#include <gtest/gtest.h>

#include "tests/support/lit_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

constexpr float hand_m = 0.30f;

class SceneViewTest : public testing::Test {
  protected:
    SceneViewTest() {
        Raycasting(device_, k_).raycast(volume_, T_g_c_, background_);
        std::vector<float> depth_m(pixels_, 0.0f);
        std::vector<float> normals_c(3 * map_pixels(shape_), 0.0f);
        for (int y = 45; y < 65; ++y) {
            for (int x = 60; x < 90; ++x) {
                depth_m[at(x, y)] = hand_m;
                foreground_[at(x, y)] = 255;
                normals_c[2 * map_pixels(shape_) + map_index(shape_, x, y)] = -1.0f;
            }
        }
        live_.depth_m.write(test::padded<float>(shape_, depth_m));
        live_.normals_c.write(normals_c);
    }

    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * k_.width_px + x); }
    SceneViewFrame frame() { return {volume_, background_, T_g_c_, area_, live_, foreground_}; }
    std::array<int, 4> rgba(const ShadedView& view, int x, int y) const {
        const std::uint8_t* pixel = &view.rgba[4 * at(x, y)];
        return {pixel[0], pixel[1], pixel[2], pixel[3]};
    }

    Device device_{DeviceConfig{}};
    const Intrinsics k_ = test::small_camera(150, 111);
    const MapShape shape_ = make_map_shape(k_);
    const std::size_t pixels_ = 150 * 111;
    TsdfVolume volume_ = restore_volume(device_, test::lit_scene_snapshot());
    RigidTransform T_g_c_ = test::looking_at({0.45f, 0.05f, -0.25f}, {0.32f, 0.42f, 0.40f});
    SurfacePrediction background_{device_, shape_};
    LiveMaps live_{device_, shape_};
    std::vector<std::uint8_t> foreground_ = std::vector<std::uint8_t>(pixels_, 0);
    const InteractiveArea area_{{-0.2f, -0.15f, 0.8f}, {0.4f, 0.0f, 0.0f}, {0.0f, 0.3f, 0.0f}};
    SceneView scene_view_{device_, k_};
};

TEST_F(SceneViewTest, AWishIsRenderedOnceAndAgainInFullWhenItRests) {
    ViewWish wish{.version = 3, .moving = true};
    EXPECT_FALSE(scene_view_.see(wish, frame())->is_full_quality);
    EXPECT_EQ(scene_view_.see(wish, frame())->version, 3);
    EXPECT_EQ(scene_view_.renderings(), 1);
    wish.moving = false;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(scene_view_.see(wish, frame())->is_full_quality);
    EXPECT_EQ(scene_view_.renderings(), 2);
    wish.version = 4;
    EXPECT_EQ(scene_view_.see(wish, frame())->version, 4);
    EXPECT_EQ(scene_view_.renderings(), 3);
}

TEST_F(SceneViewTest, AKnockedCameraSeesItsPictureAnewAndAViewOfItsOwnDoesNot) {
    const ViewWish from_camera{.version = 1};
    const ViewWish own{.version = 2, .T_g_v = T_g_c_};
    scene_view_.see(from_camera, frame());
    T_g_c_.translation().x() += 0.01f;
    Raycasting(device_, k_).raycast(volume_, T_g_c_, background_);
    scene_view_.see(from_camera, frame());
    EXPECT_EQ(scene_view_.renderings(), 2);
    scene_view_.see(own, frame());
    T_g_c_.translation().x() += 0.01f;
    scene_view_.see(own, frame());
    EXPECT_EQ(scene_view_.renderings(), 3);
}

/// What was put down meanwhile is to be seen.
TEST_F(SceneViewTest, AnOldPictureIsRenderedAnew) {
    const ViewWish wish{.version = 1};
    for (int i = 0; i < 151; ++i) scene_view_.see(wish, frame());
    EXPECT_EQ(scene_view_.renderings(), 1);
    scene_view_.see(wish, frame());
    EXPECT_EQ(scene_view_.renderings(), 2);
}

/// The same picture by both ways: the prediction lit, or cast anew from that pose.
TEST_F(SceneViewTest, ThePredictionOfTheCameraIsLitAsItIs) {
    std::ranges::fill(foreground_, std::uint8_t{0});
    const auto lit = scene_view_.see({.version = 1}, frame());
    const auto cast = scene_view_.see({.version = 2, .T_g_v = T_g_c_}, frame());
    EXPECT_EQ(lit->picture.rgba, cast->picture.rgba);
}

/// A sphere at 0.25 m hides the hand at 0.30 m; elsewhere the hand is cut out, and nothing else is.
TEST_F(SceneViewTest, HandsAreCutOutWhereTheyAreInFront) {
    ViewWish wish{.version = 1};
    EXPECT_EQ(rgba(scene_view_.see(wish, frame())->picture, 75, 55), (std::array{0, 0, 0, 0}));
    const Eigen::Vector3f near_c_m = back_project(k_, 75, 55, 0.25f);
    wish = {.version = 2, .sphere = MirrorSphere{T_g_c_ * near_c_m, 0.02f}};
    const auto view = scene_view_.see(wish, frame());
    EXPECT_EQ(rgba(view->picture, 75, 55)[3], 255);
    EXPECT_EQ(rgba(view->picture, 61, 46), (std::array{0, 0, 0, 0}));
    EXPECT_EQ(rgba(view->picture, 58, 55)[3], 255);
    EXPECT_EQ(rgba(view->picture, 10, 100)[3], 255);
}

/// From 0.2 m beside the camera, the point in the middle of the hand lies where it projects to, is bright,
/// and is not there without the style; the rest is darker than it would be.
TEST_F(SceneViewTest, TheForegroundIsDrawnIntoTheViewFromElsewhere) {
    RigidTransform T_g_v = T_g_c_;
    T_g_v.translation() += T_g_c_.linear() * Eigen::Vector3f(0.05f, 0.0f, 0.0f);
    const ViewWish plain{.version = 1, .T_g_v = T_g_v};
    const ViewWish wish{.version = 2, .T_g_v = T_g_v, .style = ViewStyle::foreground};
    const ShadedView without = scene_view_.see(plain, frame())->picture;
    const ShadedView with = scene_view_.see(wish, frame())->picture;
    const Eigen::Vector3f p_v = back_project(k_, 75, 55, hand_m) - Eigen::Vector3f(0.05f, 0.0f, 0.0f);
    const int x = static_cast<int>(std::lround(k_.fx_px * p_v.x() / p_v.z() + k_.cx_px));
    const auto hand = rgba(with, x, 55);
    EXPECT_GT(hand[0], 200);
    EXPECT_GT(hand[0], hand[2] + 60) << "the foreground's colour";
    EXPECT_NE(hand, rgba(without, x, 55));
    EXPECT_LT(2 * rgba(with, 10, 100)[0], rgba(without, 10, 100)[0] + 4);
}

/// What is behind a wall of the scan stays hidden.
TEST_F(SceneViewTest, ForegroundBehindTheScanIsNotDrawn) {
    std::vector<float> far_m(pixels_, 5.0f);
    live_.depth_m.write(test::padded<float>(shape_, far_m));
    const ViewWish wish{.version = 1, .T_g_v = T_g_c_, .style = ViewStyle::foreground};
    const ShadedView with = scene_view_.see(wish, frame())->picture;
    std::ranges::fill(foreground_, std::uint8_t{0});
    EXPECT_EQ(with.rgba, scene_view_.see(wish, frame())->picture.rgba);
}

/// A mesh of another size than the view's is left out; one that is nearer than all is there.
TEST_F(SceneViewTest, AMeshIsComposed) {
    std::ranges::fill(foreground_, std::uint8_t{0});
    auto mesh = std::make_shared<MeshPicture>();
    mesh->intrinsics = k_;
    mesh->depth_m.assign(pixels_, 0.0f);
    mesh->normals_c.assign(3 * pixels_, 0.0f);
    mesh->rgba.assign(pixels_, 0xff00ff00u);
    for (int y = 30; y < 40; ++y) {
        for (int x = 30; x < 40; ++x) {
            mesh->depth_m[at(x, y)] = 0.2f;
            mesh->normals_c[2 * pixels_ + at(x, y)] = -1.0f;
        }
    }
    const ViewWish wish{.version = 1, .mesh = mesh};
    const ShadedView view = scene_view_.see(wish, frame())->picture;
    EXPECT_GT(rgba(view, 35, 35)[1], 2 * rgba(view, 35, 35)[0]) << "green";
    EXPECT_LT(rgba(view, 45, 35)[1], rgba(view, 45, 35)[0]) << "the red wall";
    auto other = std::make_shared<MeshPicture>();
    other->depth_m.assign(10, 0.2f);
    EXPECT_NO_THROW(scene_view_.see({.version = 2, .mesh = other}, frame()));
}

}  // namespace
}  // namespace touchstone
