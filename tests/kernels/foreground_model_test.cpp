#include "tests/reference/foreground_model.hpp"

#include <gtest/gtest.h>
#include <random>

#include "pipeline/kernel_program.hpp"
#include "pipeline/map_shape.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

/// Two components with holes, a model that here and there contradicts the live depth. 101 pixels wide:
/// padded.
class ForegroundModelKernels : public testing::Test {
  protected:
    ForegroundModelKernels() {
        std::mt19937 random(4);
        std::uniform_real_distribution<float> share(0.0f, 1.0f);
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) {
                const bool hole = share(random) < 0.1f;
                const int component = x > 10 && x < 50 ? 0 : x > 60 ? 1 : -1;
                const float depth_m = 0.9f + 0.2f * share(random);
                labels.push_back(hole ? -1 : component);
                mask.push_back(labels.back() >= 0 ? 255 : 0);
                weights.push_back(static_cast<std::uint8_t>(8.0f * share(random)));
                live_m.push_back(hole ? 0.0f : depth_m);
                model_m.push_back(share(random) < 0.2f ? 0.0f : depth_m + 0.02f * (share(random) - 0.5f));
            }
        }
        std::vector<int> padded_labels(map_pixels(shape), -1);
        for (int y = 0; y < k.height_px; ++y)
            for (int x = 0; x < k.width_px; ++x)
                padded_labels[map_index(shape, x, y)] = labels[static_cast<std::size_t>(y * k.width_px + x)];
        labels_buffer.write(padded_labels);
    }
    Buffer<float> device_map(const std::vector<float>& picture) {
        return {device, test::padded<float>(shape, picture)};
    }
    Buffer<std::uint8_t> device_map(const std::vector<std::uint8_t>& picture) {
        return {device, test::padded<std::uint8_t>(shape, picture)};
    }

    Device device{DeviceConfig{}};
    Program program = load_kernel_program(device, "foreground_model.cl");
    Intrinsics k = test::small_camera(101, 60);
    MapShape shape = make_map_shape(k);
    std::vector<int> labels;
    std::vector<std::uint8_t> mask, weights;
    std::vector<float> live_m, model_m;
    Buffer<int> labels_buffer{device, map_pixels(shape)};
};

TEST_F(ForegroundModelKernels, PickComponentEqualsTheReference) {
    Buffer<std::uint8_t> own(device, map_pixels(shape)), with_free(device, map_pixels(shape)),
        others(device, map_pixels(shape));
    program.kernel("pick_component")
        .launch(eight_pixels_each(shape), labels_buffer, device_map(weights), own, with_free, others, shape,
                1);
    const reference::ComponentPick expected = reference::pick_component(labels, weights, 1);
    EXPECT_EQ(test::cropped(shape, own.read()), expected.own);
    EXPECT_EQ(test::cropped(shape, with_free.read()), expected.with_free);
    EXPECT_EQ(test::cropped(shape, others.read()), expected.others);
}

/// Launched over the tiles of a region, nothing outside them is touched.
TEST_F(ForegroundModelKernels, WhatWasPickedIsTakenBackInTheRegionAlone) {
    Buffer<std::uint8_t> own(device, map_pixels(shape)), with_free(device, map_pixels(shape)),
        others(device, map_pixels(shape));
    Buffer<float> depth_m(device, map_pixels(shape));
    for (Buffer<std::uint8_t>* map : {&own, &with_free, &others}) map->fill(7);
    depth_m.fill(0.7f);
    const LaunchSize size = eight_pixels_each(shape, {40, 20, 60, 30});
    program.kernel("drop_component").launch(size, own, with_free, others, shape);
    program.kernel("no_prediction").launch(size, depth_m, shape);
    const std::vector<std::uint8_t> weights_left = own.read(), free_left = with_free.read(),
                                    left_out = others.read();
    const std::vector<float> predicted_m = depth_m.read();
    for (int y = 0; y < shape.rows_px; ++y) {
        for (int x = 0; x < shape.pitch_px; ++x) {
            const std::size_t at = map_index(shape, x, y);
            const bool inside = x >= 32 && x < 64 && y >= 16 && y < 32;
            ASSERT_EQ(weights_left[at], inside ? 0 : 7);
            ASSERT_EQ(free_left[at], inside ? 0 : 7);
            ASSERT_EQ(left_out[at], inside ? 255 : 7);
            ASSERT_EQ(predicted_m[at], inside ? 0.0f : 0.7f);
        }
    }
}

/// Depth and source to the bit; the normals come from the same place as the depth.
TEST_F(ForegroundModelKernels, SurfaceEqualsTheReference) {
    const SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};
    Buffer<float> depth_m(device, map_pixels(shape)), normals(device, 3 * map_pixels(shape));
    Buffer<float> live_normals(device, 3 * map_pixels(shape)), model_normals(device, 3 * map_pixels(shape));
    Buffer<std::uint8_t> source(device, map_pixels(shape));
    live_normals.fill(0.25f);
    model_normals.fill(0.5f);
    depth_m.fill(0.7f);  // of the frame before
    const Buffer<float> live = device_map(live_m), model = device_map(model_m);
    program.kernel("take_live")
        .launch(eight_pixels_each(shape), device_map(mask), live, live_normals, depth_m, normals, source,
                shape);
    program.kernel("take_prediction")
        .launch(eight_pixels_each(shape), labels_buffer, live, model, model_normals, depth_m, normals, source,
                shape, noise, 3.0f, 0);
    reference::ForegroundPicture expected = reference::take_live(mask, live_m);
    reference::take_prediction(labels, live_m, model_m, shape, noise, 3.0f, 0, expected);
    EXPECT_EQ(test::cropped(shape, depth_m.read()), expected.depth_m);
    EXPECT_EQ(test::cropped(shape, source.read()), expected.source);
    const std::vector<float> x = test::cropped(shape, normals.read());
    int from_model = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::uint8_t from = expected.source[i];
        EXPECT_EQ(x[i], from == FOREGROUND_MODEL ? 0.5f : from == FOREGROUND_LIVE ? 0.25f : 0.0f) << i;
        from_model += from == FOREGROUND_MODEL;
    }
    EXPECT_GT(from_model, 500);
}

}  // namespace
}  // namespace touchstone
