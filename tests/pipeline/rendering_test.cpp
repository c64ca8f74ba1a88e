#include "pipeline/rendering.hpp"

#include <gtest/gtest.h>

#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

/// A wall that faces the camera, foreground on the right half, nothing known in the first column. 70 pixels
/// wide: padded.
class RenderingTest : public testing::Test {
  protected:
    RenderingTest() {
        std::vector<float> depth_m(static_cast<std::size_t>(k.width_px * k.height_px), 1.0f);
        std::vector<std::uint8_t> moving(depth_m.size(), 0);
        for (int y = 0; y < k.height_px; ++y) {
            depth_m[static_cast<std::size_t>(y * k.width_px)] = 0.0f;
            for (int x = k.width_px / 2; x < k.width_px; ++x)
                moving[static_cast<std::size_t>(y * k.width_px + x)] = 255;
        }
        background.depth_m.write(test::padded<float>(shape, depth_m));
        std::vector<float> normals(3 * map_pixels(shape), 0.0f);
        std::fill(normals.begin() + static_cast<std::ptrdiff_t>(2 * map_pixels(shape)), normals.end(), -1.0f);
        background.normals_c.write(normals);
        live.normals_c.write(normals);
        foreground.write(test::padded<std::uint8_t>(shape, moving));
        view = Rendering(device, config, k).render(background, {live.normals_c, foreground});
    }
    std::array<int, 4> pixel(int x, int y) const {
        const auto at = static_cast<std::size_t>(4 * (y * k.width_px + x));
        return {view.rgba[at], view.rgba[at + 1], view.rgba[at + 2], view.rgba[at + 3]};
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(70, 41);
    MapShape shape = make_map_shape(k);
    RenderingConfig config;
    SurfacePrediction background{device, shape};
    LiveMaps live{device, shape};
    Buffer<std::uint8_t> foreground{device, map_pixels(shape)};
    ShadedView view;
};

TEST_F(RenderingTest, HasTheSizeOfThePicture) {
    EXPECT_EQ(view.width_px, 70);
    EXPECT_EQ(view.height_px, 41);
    EXPECT_EQ(view.rgba.size(), 4u * 70u * 41u);
}

TEST_F(RenderingTest, UnknownBackgroundAndForegroundDiffer) {
    const auto unknown = pixel(0, 20), table = pixel(20, 20), hand = pixel(50, 20);
    EXPECT_EQ(unknown[0], static_cast<int>(std::lround(config.shading.unknown.x * 255.0f)));
    EXPECT_GT(table[2], table[0]) << "the background is bluish";
    EXPECT_GT(hand[0], hand[2] + 40) << "the foreground is warm";
    EXPECT_EQ(unknown[3], 255);
    EXPECT_EQ(table[3], 255);
    EXPECT_EQ(hand[3], 0) << "paint goes under the foreground";
}

TEST_F(RenderingTest, BrightnessIsPhongs) {
    // At the principal point: facing 1, diffuse = light's z, level and shine as in shading.cl.
    const float diffuse = config.shading.light_c.z;
    const float shine = std::pow(diffuse, 8.0f);
    const float red =
        config.shading.background.x * (0.55f + 0.45f * diffuse) + config.shading.background.w * shine;
    EXPECT_NEAR(pixel(34, 20)[0], 255.0f * std::min(red, 1.0f), 2.0f);
}

TEST_F(RenderingTest, TheCamerasOwnPictureLetsPaintGoUnderTheForeground) {
    const Intrinsics two{100.0f, 100.0f, 0.5f, 0.0f, 2, 1, {0, 0}};
    const std::array<std::uint8_t, 6> rgb{10, 20, 30, 40, 50, 60};
    const std::array<std::uint8_t, 2> moving{0, 255};
    const ShadedView own = camera_view(rgb, moving, two);
    EXPECT_EQ(own.width_px, 2);
    EXPECT_EQ(own.height_px, 1);
    EXPECT_EQ(own.rgba, (std::vector<std::uint8_t>{10, 20, 30, 255, 40, 50, 60, 0}));
}

TEST_F(RenderingTest, NormalsAreColours) {
    std::vector<float> up(3 * map_pixels(shape), 0.0f);
    const auto plane = static_cast<std::ptrdiff_t>(map_pixels(shape));
    std::fill(up.begin() + plane, up.begin() + 2 * plane, -1.0f);  // y points down
    live.normals_c.write(up);
    config.view = "normals";
    view = Rendering(device, config, k).render(background, {live.normals_c, foreground});
    const std::array facing{128, 128, 255, 255}, hand_up{128, 255, 128, 0};
    EXPECT_EQ(pixel(20, 20), facing);
    EXPECT_EQ(pixel(50, 20), hand_up);
    EXPECT_EQ(pixel(0, 20)[2], static_cast<int>(std::lround(config.shading.unknown.z * 255.0f)));
}

TEST_F(RenderingTest, AForegroundWithoutNormalFacesTheCamera) {
    live.normals_c.fill(0.0f);
    const std::array before = pixel(50, 20);
    view = Rendering(device, config, k).render(background, {live.normals_c, foreground});
    EXPECT_EQ(pixel(50, 20), before);
}

TEST_F(RenderingTest, AnUnknownViewIsRefused) {
    config.view = "wireframe";
    EXPECT_THROW(Rendering(device, config, k), Error);
}

}  // namespace
}  // namespace touchstone
