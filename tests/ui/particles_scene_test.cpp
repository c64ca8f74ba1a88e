// Pixels of the particles scene: where spheres are, what hides them, what they darken.
#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include "picture_probe.hpp"
#include "platform/display/headless_display.hpp"
#include "scene_fixture.hpp"
#include "ui/layout.hpp"
#include "ui/scenes/particles.hpp"
#include "ui/table_presenter.hpp"

namespace touchstone {
namespace {

constexpr PixelSize display_size{1280, 720};
constexpr PixelSize view_size{320, 240};

class ParticlesSceneTest : public testing::Test {
  protected:
    ParticlesSceneTest() {
        auto view = std::make_shared<ShadedView>();
        *view = {view_size.width_px, view_size.height_px, std::vector<std::uint8_t>(320 * 240 * 4, 200)};
        for (std::size_t i = 3; i < view->rgba.size(); i += 4) view->rgba[i] = 255;
        frame_.state = "live";
        frame_.view = view;
        particles_.intrinsics = {300.0f, 300.0f, 159.5f, 119.5f, 320, 240, {0, 0}};
        particles_.radius_m = 0.05f;  // 15 pixels of the view at 1 m
        particles_.depth_mm.assign(320 * 240, 1050);
    }
    /// What is shown at a place of the view.
    style::Color shown_at(const Eigen::Vector2f& view_px) {
        frame_.particles = std::make_shared<ParticleView>(particles_);
        ++frame_.index;
        presenter_.present(frame_, 0.03f);
        const Picture picture = display_->read_pixels();
        const Layout layout = make_layout(display_size, view_size);
        const Eigen::Vector2f at = layout.view.to_display(view_px);
        return color_at(picture, static_cast<int>(at.x()), static_cast<int>(at.y()));
    }
    static int brightness(const style::Color& c) { return c.r + c.g + c.b; }
    /// On the axis: at the view's middle.
    static ParticleSphere sphere_at(float z_m) { return {{0.0f, 0.0f, z_m}, {0.0f, 0.0f, 1.05f}, 0.0f, 0}; }

    std::unique_ptr<Display> display_ = make_headless_display(display_size);
    TablePresenter presenter_{*display_, "particles"};
    TableFrame frame_;
    ParticleView particles_;
    const Eigen::Vector2f middle_px_{159.5f, 119.5f};
};

TEST_F(ParticlesSceneTest, ASphereIsADiscOfItsRadius) {
    const style::Color bare = shown_at(middle_px_);
    particles_.spheres = {sphere_at(1.0f)};
    EXPECT_NE(shown_at(middle_px_), bare);
    EXPECT_NE(shown_at(middle_px_ + Eigen::Vector2f(13.5f, 0.0f)), bare);
    EXPECT_EQ(shown_at(middle_px_ + Eigen::Vector2f(16.5f, 0.0f)), bare);
    EXPECT_EQ(shown_at(middle_px_ - Eigen::Vector2f(0.0f, 16.5f)), bare);
}

/// A real edge at 0.9 m over the right half hides it there, to a pixel.
TEST_F(ParticlesSceneTest, RealThingsHideSpheresToThePixel) {
    const style::Color bare = shown_at(middle_px_);
    particles_.spheres = {sphere_at(1.0f)};
    for (std::size_t y = 0; y < 240; ++y)
        for (std::size_t x = 160; x < 320; ++x) particles_.depth_mm[y * 320 + x] = 900;
    EXPECT_NE(shown_at({158.5f, 119.5f}), bare);
    EXPECT_EQ(shown_at({160.5f, 119.5f}), bare);
    EXPECT_EQ(shown_at({169.5f, 119.5f}), bare);
}

/// Its front half stands out of a surface through its middle.
TEST_F(ParticlesSceneTest, ASphereStandsOutOfASurface) {
    const style::Color bare = shown_at(middle_px_);
    particles_.spheres = {sphere_at(1.0f)};
    particles_.depth_mm.assign(320 * 240, 975);
    // 25 mm of 50 are before 0.975 m within sqrt(50^2 - 25^2) = 43 mm, 13 pixels.
    EXPECT_NE(shown_at(middle_px_ + Eigen::Vector2f(12.0f, 0.0f)), bare);
    EXPECT_EQ(shown_at(middle_px_ + Eigen::Vector2f(14.5f, 0.0f)), bare);
}

TEST_F(ParticlesSceneTest, AShadowDarkensTheSurfaceAndNoHand) {
    const int bare = brightness(shown_at(middle_px_));
    ParticleSphere aside = sphere_at(1.0f);
    aside.centre_c_m.x() = 0.3f;
    aside.shadow = 1.0f;
    particles_.spheres = {aside};
    EXPECT_LT(brightness(shown_at(middle_px_)), bare - 60);
    particles_.depth_mm.assign(320 * 240, 900);
    EXPECT_EQ(brightness(shown_at(middle_px_)), bare);
}

TEST_F(ParticlesSceneTest, TheNearerCoversTheFarther) {
    particles_.spheres = {sphere_at(1.0f), sphere_at(0.8f)};
    particles_.spheres[1].id = 7;  // another colour
    const style::Color both = shown_at(middle_px_);
    particles_.spheres.erase(particles_.spheres.begin());
    EXPECT_EQ(shown_at(middle_px_), both);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

class ParticleToolsTest : public SceneFixture {
  protected:
    ParticleToolsTest() {
        open("particles");
        const SurfaceGeometry surface(frame_, view_size);
        pad_.lay_out(surface);
        reset_ = surface.bottom_row(20.f).center();
    }
    TiltPad pad_;
    Eigen::Vector2f reset_;
};

TEST_F(ParticleToolsTest, TheButtonClearsOnceForEachTouch) {
    EXPECT_EQ(presenter_->wish().particles_cleared, 0);
    tap(reset_);
    EXPECT_EQ(presenter_->wish().particles_cleared, 1);
    pass(0.3f);
    tap(reset_);
    EXPECT_EQ(presenter_->wish().particles_cleared, 2);
    tap({160.f, 120.f});
    EXPECT_EQ(presenter_->wish().particles_cleared, 2);
}

TEST_F(ParticleToolsTest, TheKnobTiltsAlongTheAreaAndSpringsBack) {
    const Eigen::Vector2f right = pad_.center_px() + Eigen::Vector2f(pad_.radius_px(), 0.f);
    present({touch(1, TouchPhase::down, pad_.center_px())});
    EXPECT_LT(presenter_->wish().tilt.norm(), 0.01f);
    present({touch(1, TouchPhase::move, right)});
    EXPECT_NEAR(presenter_->wish().tilt.x(), ParticlesScene::most_tilt, 1e-3f);
    EXPECT_NEAR(presenter_->wish().tilt.y(), 0.f, 1e-3f);
    present({touch(1, TouchPhase::move, {0.f, pad_.center_px().y()})});
    EXPECT_NEAR(presenter_->wish().tilt.x(), -ParticlesScene::most_tilt, 1e-3f) << "no farther";
    present({touch(1, TouchPhase::up, right)});
    pass(0.1f);
    EXPECT_LT(presenter_->wish().tilt.norm(), ParticlesScene::most_tilt);
    pass(1.5f);
    EXPECT_EQ(presenter_->wish().tilt, Eigen::Vector2f(0.f, 0.f));
}

TEST_F(ParticleToolsTest, ThePadIsLargeEnoughForAFingerAndInTheArea) {
    const SurfaceGeometry surface(frame_, view_size);
    EXPECT_GE(2.f * pad_.radius_px() * surface.mm_per_px(pad_.center_px()), 16.f);
    const Eigen::Vector2f half = Eigen::Vector2f::Constant(pad_.radius_px());
    EXPECT_TRUE(surface.room().box_px().contains(
        Eigen::AlignedBox2f(pad_.center_px() - half, pad_.center_px() + half)));
}

TEST_F(ParticleToolsTest, AFingerOnAControlDoesNotPour) {
    const Eigen::Vector2f free_px(160.f, 120.f);
    present({touch(1, TouchPhase::down, free_px), touch(2, TouchPhase::down, pad_.center_px()),
             touch(3, TouchPhase::down, reset_), touch(4, TouchPhase::down, menu_tile_px(""))});
    EXPECT_EQ(presenter_->wish().pouring_fingers, (std::vector<int>{1}));
    present({touch(1, TouchPhase::up, free_px)});
    EXPECT_TRUE(presenter_->wish().pouring_fingers.empty());
}

}  // namespace
}  // namespace touchstone
