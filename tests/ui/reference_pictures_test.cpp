// What the scenes look like, against pictures that people have looked at (tests/ui/reference). Renew them
// with TOUCHSTONE_RENEW_REFERENCES=1 in the environment, and look at them.
#include <cstdlib>
#include <filesystem>

#include "platform/image/png_file.hpp"
#include "scene_fixture.hpp"

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
