#include "pipeline/depth_map_conversion.hpp"

#include <gtest/gtest.h>
#include <random>

#include "tests/reference/depth_map_conversion.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using test::cropped;

FilterParams params_of(const DepthMapConversionConfig& config) {
    return {config.noise, config.filter_sigma_px, config.filter_range_sigmas, config.min_depth_m,
            config.max_depth_m};
}

/// A tilted plane with a ball, noise of 2 mm, single-pixel holes and values out of range.
std::vector<std::uint16_t> noisy_scene_mm(const Intrinsics& k) {
    const auto surface = test::both(test::plane(Eigen::Vector3f(0.1f, 0.5f, 1.0f).normalized(), 1.0f),
                                    test::sphere({0.05f, 0.0f, 0.8f}, 0.12f));
    std::vector<std::uint16_t> depth_mm = test::to_mm(test::render_depth_m(k, surface));
    std::mt19937 random(7);
    std::normal_distribution<float> noise_mm(0.0f, 2.0f);
    for (std::uint16_t& mm : depth_mm) {
        mm = static_cast<std::uint16_t>(static_cast<float>(mm) + noise_mm(random));
        if (random() % 17 == 0) mm = 0;
        if (random() % 97 == 0) mm = 65535;
        if (random() % 97 == 0) mm = 100;
    }
    return depth_mm;
}

class DepthMapConversionTest : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(DepthMapConversionTest, AgreesWithTheReference) {
    const Device device(DeviceConfig{});
    const Intrinsics k = test::small_camera(GetParam().first, GetParam().second);
    const DepthMapConversionConfig config;
    DepthMapConversion conversion(device, config, k);
    LiveMaps live(device, make_map_shape(k));
    const std::vector<std::uint16_t> depth_mm = noisy_scene_mm(k);
    conversion.convert({depth_mm, k}, live);

    const reference::Picture depth =
        reference::convert_depth(depth_mm, k.width_px, k.height_px, params_of(config));
    const reference::Picture filtered = reference::bilateral_filter(depth, params_of(config));
    const std::vector<float> raw_m = cropped(live.shape, live.depth_m.read());
    const std::vector<float> filtered_m = cropped(live.shape, live.filtered_m.read());
    const std::vector<float> normals = live.normals_c.read();
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto pixel = static_cast<std::size_t>(y * k.width_px + x);
            ASSERT_NEAR(raw_m[pixel], depth.at(x, y), 1e-6f) << x << " " << y;
            ASSERT_NEAR(filtered_m[pixel], filtered.at(x, y), 2e-6f) << x << " " << y;
            // From the kernel's own filtered depth, so that only the normals are compared: 1 mrad.
            const reference::Picture own{k.width_px, k.height_px, filtered_m};
            const Eigen::Vector3f expected = reference::normal(own, k, x, y, config.normal_gap_per_m);
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t at =
                    static_cast<std::size_t>(axis) * map_pixels(live.shape) + map_index(live.shape, x, y);
                ASSERT_NEAR(normals[at], expected[axis], 1e-3f) << x << " " << y << " axis " << axis;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, DepthMapConversionTest,
                         testing::Values(std::pair{96, 80}, std::pair{70, 41}, std::pair{16, 16},
                                         std::pair{3, 2}));

TEST(DepthMapConversion, WhatIsMissingDoesNotCountHoweverNoisyTheSensorIs) {
    const Device device(DeviceConfig{});
    const Intrinsics k = test::small_camera();
    DepthMapConversionConfig config;
    config.noise.constant_m = 2.0f;
    DepthMapConversion conversion(device, config, k);
    LiveMaps live(device, make_map_shape(k));
    const std::vector<std::uint16_t> depth_mm = noisy_scene_mm(k);
    conversion.convert({depth_mm, k}, live);
    const reference::Picture filtered = reference::bilateral_filter(
        reference::convert_depth(depth_mm, k.width_px, k.height_px, params_of(config)), params_of(config));
    const std::vector<float> filtered_m = cropped(live.shape, live.filtered_m.read());
    for (std::size_t i = 0; i < filtered_m.size(); ++i)
        ASSERT_NEAR(filtered_m[i], filtered.depth_m[i], 5e-6f) << i;
}

TEST(DepthMapConversion, NormalsOfAPlaneAreItsNormal) {
    const Device device(DeviceConfig{});
    const Intrinsics k = test::small_camera();
    const Eigen::Vector3f n = Eigen::Vector3f(0.2f, -0.6f, -1.0f).normalized();
    DepthMapConversion conversion(device, {}, k);
    LiveMaps live(device, make_map_shape(k));
    // Millimetres rounded to 1 mm over 10 mm pixels tilt single normals by up to 0.1 rad; their mean must not
    // lean.
    conversion.convert({test::to_mm(test::render_depth_m(k, test::plane(n, -1.0f))), k}, live);
    const std::vector<float> normals = live.normals_c.read();
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const float value : cropped(live.shape, normals, axis)) mean[static_cast<int>(axis)] += value;
    }
    EXPECT_GT(mean.normalized().dot(n), std::cos(0.005f));
}

TEST(DepthMapConversion, EmptyPictureGivesEmptyMaps) {
    const Device device(DeviceConfig{});
    const Intrinsics k = test::small_camera();
    DepthMapConversion conversion(device, {}, k);
    LiveMaps live(device, make_map_shape(k));
    const std::vector<std::uint16_t> depth_mm(static_cast<std::size_t>(k.width_px * k.height_px), 0);
    conversion.convert({depth_mm, k}, live);
    EXPECT_EQ(live.filtered_m.read(), std::vector<float>(map_pixels(live.shape), 0.0f));
    EXPECT_EQ(live.normals_c.read(), std::vector<float>(3 * map_pixels(live.shape), 0.0f));
}

TEST(DepthMapConversion, ColumnShiftIsAddedToInverseDepth) {
    const Device device(DeviceConfig{});
    const Intrinsics k = test::small_camera();
    DepthMapConversion conversion(device, {}, k);
    LiveMaps live(device, make_map_shape(k));
    const std::vector<std::uint16_t> depth_mm(static_cast<std::size_t>(k.width_px * k.height_px), 2000);
    std::vector<float> shift_per_m(static_cast<std::size_t>(k.width_px), 0.0f);
    shift_per_m[10] = 0.1f;
    conversion.set_column_shift(shift_per_m);
    conversion.convert({depth_mm, k}, live);
    const std::vector<float> depth_m = cropped(live.shape, live.depth_m.read());
    EXPECT_NEAR(depth_m[9], 2.0f, 1e-6f);
    EXPECT_NEAR(depth_m[10], 1.0f / (0.5f + 0.1f), 1e-6f);
}

}  // namespace
}  // namespace touchstone
