// What the scenes look like, against pictures that people have looked at (tests/ui/reference). Renew them
// with TOUCHSTONE_RENEW_REFERENCES=1 in the environment, and look at them.
#include <cstdlib>
#include <filesystem>

#include "platform/image/png_file.hpp"
#include "scene_fixture.hpp"
#include "ui/operator_panel.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;

/// Of 255: rasterisers and font hinting differ by so much at edges. More than that in one of 200 pixels is
/// another picture.
constexpr int color_tolerance = 32;
constexpr double differing_share = 0.005;

class ReferencePictures : public SceneFixture {
  protected:
    ReferencePictures() {
        auto gray = std::make_shared<ShadedView>(*frame_.view);
        for (std::size_t i = 0; i < gray->rgba.size(); ++i)
            if (i % 4 != 3) gray->rgba[i] = static_cast<std::uint8_t>(145 + 6 * (i % 4));
        frame_.view = gray;
    }

    static void compare(const Picture& shown, const std::string& name) {
        const std::filesystem::path file =
            std::filesystem::path(TOUCHSTONE_SOURCE_DIR) / "tests/ui/reference" / (name + ".png");
        if (std::getenv("TOUCHSTONE_RENEW_REFERENCES") != nullptr) {
            Image8 image{shown.width_px, shown.height_px, 3, {}};
            for (std::size_t i = 0; i < shown.rgba.size(); ++i)
                if (i % 4 != 3) image.pixels.push_back(shown.rgba[i]);
            write_png(file, image);
            GTEST_SKIP() << "renewed " << file;
        }
        const Image8 kept = read_png_8(file);
        ASSERT_EQ(kept.channels, 3);
        ASSERT_EQ(PixelSize(kept.width_px, kept.height_px), PixelSize(shown.width_px, shown.height_px));
        Picture reference{kept.width_px, kept.height_px, {}};
        for (std::size_t i = 0; i < kept.pixels.size(); i += 3)
            reference.rgba.insert(reference.rgba.end(),
                                  {kept.pixels[i], kept.pixels[i + 1], kept.pixels[i + 2], 255});
        const int differing = count_differences(shown, reference, color_tolerance);
        EXPECT_LT(differing, differing_share * kept.width_px * kept.height_px) << name;
    }
};

TEST_F(ReferencePictures, Paint) {
    open("paint");
    for (int i = 0; i < 8; ++i) {
        const float y = 75.f + 12.f * static_cast<float>(i);
        stroke({70.f, y}, {250.f, y + 14.f * std::sin(static_cast<float>(i))}, 12);
    }
    compare(present({}, {HoverEvent{touch(99, TouchPhase::move, {280.f, 100.f}).tip}}), "paint");
}

TEST_F(ReferencePictures, OperatorPanel) {
    auto view = std::make_shared<OperatorView>();
    view->camera = "Kinect v1 at USB 1-2.3";
    view->device = "pthread-cortex-a76";
    view->camera_rate_hz = 30.f;
    for (const char* stage : {"depth map conversion", "foreground segmentation", "touch detection",
                              "touches out", "volumetric integration, raycast", "frame"})
        view->stages.push_back({stage, 3.5, 5.25, 300});
    view->faults = {"14:03:12 silent: The depth camera is silent", "13:58:01 lost: it was pulled out"};
    view->can_record = view->can_calibrate_projector = true;
    view->projector = "The projector's light falls right: 0.4 mm (0.5 pixels) off, by 12 squares.";
    view->depth.size = view->mask.size = {160, 120};
    for (int i = 0; i < 160 * 120; ++i) {
        view->depth.gray.push_back(static_cast<std::uint8_t>(i % 160 + 40));
        view->mask.gray.push_back(i % 160 > 60 && i % 160 < 90 && i / 160 > 50 ? 255 : 0);
    }
    frame_.operating = view;
    frame_.frame_rate_hz = 29.9f;
    open("paint");
    tap(frame_.area_px[0] + Vector2f(3.f, 3.f), 2.2f);
    pass(0.3f);
    compare(present(), "operator_panel");
}

/// Two areas, the left one chosen, and after that three corners of a new one.
TEST_F(ReferencePictures, Areas) {
    auto view = std::make_shared<OperatorView>();
    view->can_change_areas = true;
    frame_.operating = view;
    const auto add = [&](const char* name, const char* scene, const std::vector<Vector2f>& corners_px) {
        ShownArea& area = frame_.areas.emplace_back();
        area.name = name;
        area.scene = scene;
        area.triangles = {0, 1, 2, 0, 2, 3};
        area.corners_px = corners_px;
        area.area = frame_.area;
        area.area_px = frame_.area_px;
    };
    add("area-1", "photos", {{25.f, 50.f}, {110.f, 40.f}, {120.f, 170.f}, {30.f, 175.f}});
    add("area-2", "", {{215.f, 40.f}, {300.f, 55.f}, {290.f, 170.f}, {205.f, 175.f}});
    open("paint");
    tap(frame_.area_px[0] + Vector2f(3.f, 3.f), 2.2f);
    const Layout layout = make_layout(display_size, view_size);
    Canvas canvas;
    canvas.begin({960.f, 600.f}, layout.scale);
    OperatorPanel panel;
    panel.draw(canvas, layout.view, SurfaceGeometry(frame_, view_size), frame_);
    tap(panel.place_px(OperatorButton::areas).center());
    const auto touch_of = [&](int area, const Vector2f& place_px) {
        const int id = ++ids_given_;
        for (const TouchPhase phase : {TouchPhase::down, TouchPhase::up}) {
            TouchEvent event = touch(id, phase, place_px);
            event.tip.area = area;
            present({event});
        }
    };
    touch_of(0, {70.f, 60.f});
    compare(present(), "area_chosen");
    for (const Vector2f& corner : {Vector2f(130.f, 60.f), Vector2f(190.f, 60.f), Vector2f(195.f, 150.f)})
        touch_of(-1, corner);
    pass(0.3f);
    compare(present(), "area_drawn");
}

TEST_F(ReferencePictures, Menu) {
    open("photos");
    pass(0.2f);
    tap(menu_tile_px(""));
    pass(0.3f);
    compare(present(), "menu");
}

TEST_F(ReferencePictures, Photos) {
    open("photos");
    pass(0.2f);
    compare(present({touch(1, TouchPhase::down, {90.f, 80.f})}), "photos");
}

TEST_F(ReferencePictures, Attract) {
    PresenterConfig config;
    config.attract_after_s = 1.f;
    open("paint", config);
    pass(8.f);
    compare(present(), "attract");
}

TEST_F(ReferencePictures, Particles) {
    open("particles");
    auto particles = std::make_shared<ParticleView>();
    particles->intrinsics = frame_.intrinsics;
    particles->radius_m = 0.02f;
    particles->depth_mm.assign(320 * 240, 1100);
    for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3f at(0.04f * static_cast<float>(i % 10) - 0.2f,
                                 0.04f * static_cast<float>(i / 10), 1.08f);
        particles->spheres.push_back({at, at + Eigen::Vector3f(0.f, 0.f, 0.02f), 1.f, i});
    }
    frame_.particles = particles;
    compare(present(), "particles");
}

}  // namespace
}  // namespace touchstone
