// Half sampling, leaving pixels out and brightness, against their references; the padding stays empty.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "pipeline/camera_tracking.hpp"
#include "pipeline/kernel_program.hpp"
#include "tests/reference/listing_1_camera_tracking.hpp"
#include "tests/support/oriented_scene.hpp"

namespace touchstone {
namespace {

constexpr float gap_per_m = 0.03f;

MapShape half_shape(const Intrinsics& k) { return make_map_shape(reference::half_intrinsics(k)); }

void expect_empty_padding(const MapShape& shape, const std::vector<float>& map) {
    for (int y = 0; y < shape.rows_px; ++y) {
        for (int x = 0; x < shape.pitch_px; ++x) {
            if (x < shape.width_px && y < shape.height_px) continue;
            ASSERT_EQ(map[map_index(shape, x, y)], 0.0f) << x << " " << y;
        }
    }
}

class ImagePyramidTest : public testing::TestWithParam<std::pair<int, int>> {
  protected:
    const Device device_{DeviceConfig{}};
    const Program program_ = load_kernel_program(device_, "listing_1_camera_tracking.cl");
    const Intrinsics k_ = test::small_camera(GetParam().first, GetParam().second);
    const MapShape shape_ = make_map_shape(k_);
};

TEST_P(ImagePyramidTest, HalfSamplingAgreesWithTheReference) {
    std::mt19937 random(3);
    reference::Picture source{k_.width_px, k_.height_px,
                              test::render_depth_m(k_, test::both(test::plane({0.2f, 0.1f, 1.0f}, 1.2f),
                                                                  test::sphere({0.0f, 0.1f, 0.9f}, 0.2f)))};
    for (float& z : source.depth_m) {
        z *= 1.0f + 0.00002f * static_cast<float>(random() % 1000);
        if (random() % 4 == 0) z = 0.0f;
        if (random() % 9 == 0) z *= 1.5f;
    }
    const MapShape half = half_shape(k_);
    const Buffer<float> source_m(device_, test::padded<float>(shape_, source.depth_m));
    Buffer<float> half_m(device_, std::vector<float>(map_pixels(half), -1.0f));
    program_.kernel("half_sample").launch(eight_pixels_each(half), source_m, half_m, shape_, half, gap_per_m);
    const std::vector<float> map = half_m.read();
    const reference::Picture expected = reference::half_sample(source, gap_per_m);
    const std::vector<float> got = test::cropped(half, map);
    ASSERT_EQ(got.size(), expected.depth_m.size());
    for (std::size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i], expected.depth_m[i], 1e-6f) << i;
    expect_empty_padding(half, map);
}

TEST_P(ImagePyramidTest, LeavesOutWhatTheMaskNames) {
    std::mt19937 random(4);
    std::vector<float> depth_m, expected;
    std::vector<std::uint8_t> mask;
    for (int i = 0; i < k_.width_px * k_.height_px; ++i) {
        depth_m.push_back(0.001f * static_cast<float>(random() % 3000));
        mask.push_back(random() % 3 == 0 ? static_cast<std::uint8_t>(1 + random() % 255) : std::uint8_t{0});
        expected.push_back(mask.back() == 0 ? depth_m.back() : 0.0f);
    }
    const Buffer<float> source_m(device_, test::padded<float>(shape_, depth_m));
    const Buffer<std::uint8_t> excluded(device_, test::padded<std::uint8_t>(shape_, mask));
    Buffer<float> result_m(device_, map_pixels(shape_));
    program_.kernel("leave_out").launch(eight_pixels_each(shape_), source_m, excluded, result_m, shape_);
    EXPECT_EQ(test::cropped(shape_, result_m.read()), expected);
    expect_empty_padding(shape_, result_m.read());
}

TEST_P(ImagePyramidTest, BrightnessAndItsHalvesAgreeWithTheReference) {
    std::mt19937 random(5);
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < 3 * k_.width_px * k_.height_px; ++i)
        rgb.push_back(static_cast<std::uint8_t>(random() % 256));
    IntensityMaps maps(device_, k_);
    CameraTracking tracking(device_, {}, k_);
    tracking.convert(rgb, maps);
    reference::Picture expected{k_.width_px, k_.height_px, reference::brightness(rgb)};
    Intrinsics k = k_;
    for (const Buffer<float>& level : maps.levels) {
        const std::vector<float> got = test::cropped(make_map_shape(k), level.read());
        ASSERT_EQ(got.size(), expected.depth_m.size());
        for (std::size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i], expected.depth_m[i], 2e-6f) << i;
        expected = reference::half_sample(expected, 1e9f);  // the plain mean: nothing random is exactly 0
        k = reference::half_intrinsics(k);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ImagePyramidTest,
                         testing::Values(std::pair{96, 80}, std::pair{70, 50}, std::pair{37, 19}));

/// A mean over an edge would be a point in the air.
TEST(ImagePyramid, DoesNotAverageOverAnEdge) {
    const reference::Picture edge{4, 2, {1.0f, 2.0f, 1.0f, 1.02f, 0.0f, 2.0f, 0.0f, 1.06f}};
    EXPECT_THAT(reference::half_sample(edge, gap_per_m).depth_m,
                testing::Pointwise(testing::FloatNear(1e-6f), {1.0f, 1.01f}));
    const Device device(DeviceConfig{});
    const Program program = load_kernel_program(device, "listing_1_camera_tracking.cl");
    const Intrinsics k = test::small_camera(4, 2);
    const MapShape shape = make_map_shape(k), half = half_shape(k);
    const Buffer<float> source_m(device, test::padded<float>(shape, edge.depth_m));
    Buffer<float> half_m(device, map_pixels(half));
    program.kernel("half_sample").launch(eight_pixels_each(half), source_m, half_m, shape, half, gap_per_m);
    EXPECT_THAT(test::cropped(half, half_m.read()),
                testing::Pointwise(testing::FloatNear(1e-6f), {1.0f, 1.01f}));
}

}  // namespace
}  // namespace touchstone
