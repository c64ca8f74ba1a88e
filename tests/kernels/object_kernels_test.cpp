#include <gtest/gtest.h>
#include <random>

#include "pipeline/kernel_program.hpp"
#include "pipeline/map_shape.hpp"
#include "platform/opencl/buffer.hpp"
#include "tests/reference/scan_stillness.hpp"

namespace touchstone {
namespace {

class ObjectKernels : public testing::Test {
  protected:
    std::vector<float> depths(unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> depth_m(0.8f, 1.2f), hole(0.0f, 1.0f);
        std::vector<float> map(map_pixels(shape));
        for (float& z : map) z = hole(random) < 0.2f ? 0.0f : depth_m(random);
        return map;
    }

    Device device{DeviceConfig{}};
    MapShape shape = make_map_shape({100.0f, 100.0f, 39.5f, 29.5f, 80, 60, {0, 0}});
};

/// To the bit, pixel by pixel; outside the rectangle nothing changes.
TEST_F(ObjectKernels, TheNearerSurfaceLiesOver) {
    const std::size_t plane = map_pixels(shape);
    const std::vector<float> over = depths(1), under = depths(2);
    std::vector<float> over_normals(3 * plane, 0.25f), normals(3 * plane, 0.5f);
    Buffer<float> depth_m(device, under), normals_c(device, normals);
    const Program program = load_kernel_program(device, "settled_objects.cl");
    Kernel lay_over = program.kernel("lay_over");
    const int x0 = 16, y0 = 7;
    for (int twice = 0; twice < 2; ++twice)
        lay_over.launch({{4, 20, 1}, {1, 1, 1}}, Buffer<float>(device, over),
                        Buffer<float>(device, over_normals), depth_m, normals_c, x0, y0, shape);
    const std::vector<float> got = depth_m.read(), got_normals = normals_c.read();
    int taken_pixels = 0;
    for (int y = 0; y < shape.rows_px; ++y) {
        for (int x = 0; x < shape.pitch_px; ++x) {
            const std::size_t at = map_index(shape, x, y);
            const bool in = x >= x0 && x < x0 + 32 && y >= y0 && y < y0 + 20;
            const bool taken = in && over[at] > 0.0f && (under[at] <= 0.0f || over[at] < under[at]);
            taken_pixels += taken;
            ASSERT_EQ(got[at], taken ? over[at] : under[at]) << x << " " << y;
            for (std::size_t axis = 0; axis < 3; ++axis)
                ASSERT_EQ(got_normals[axis * plane + at], taken ? 0.25f : 0.5f);
        }
    }
    EXPECT_GT(taken_pixels, 100);
}

TEST_F(ObjectKernels, MasksAreJoined) {
    std::vector<std::uint8_t> a(map_pixels(shape)), b(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] = i % 3 == 0 ? 255 : 0;
        b[i] = i % 5 == 0 ? 1 : 0;
    }
    Buffer<std::uint8_t> joined(device, a.size());
    const Program program = load_kernel_program(device, "foreground_segmentation.cl");
    program.kernel("join_masks")
        .launch(eight_pixels_each(shape), Buffer<std::uint8_t>(device, a), Buffer<std::uint8_t>(device, b),
                joined, shape);
    const std::vector<std::uint8_t> got = joined.read();
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(got[i], i % 3 == 0 || i % 5 == 0 ? 255 : 0);
}

/// 40 frames of noise, holes, things that come and go; means within 1e-5 m, everything else the same.
TEST_F(ObjectKernels, StillnessAsTheReferenceSees) {
    const SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};
    const float quantisation = 0.00084f, sigmas = 4.0f;
    const int least = 5;
    const std::size_t pixels = map_pixels(shape);
    Buffer<float> depth_m(device, pixels), filtered_m(device, pixels), mean_m(device, pixels),
        other_m(device, pixels);
    Buffer<std::uint8_t> frames(device, pixels), others(device, pixels), moving(device, pixels),
        replaced(device, pixels);
    for (Buffer<float>* map : {&mean_m, &other_m}) map->fill(0.0f);
    for (Buffer<std::uint8_t>* map : {&frames, &others, &moving, &replaced}) map->fill(0);
    const Program program = load_kernel_program(device, "scan_stillness.cl");
    Kernel judge = program.kernel("judge_stillness");
    std::vector<reference::StillPixel> expected(pixels);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    std::normal_distribution<float> jitter(0.0f, 0.0015f);
    std::vector<int> level(pixels, 0);
    int replacements = 0, moves = 0;
    for (int frame = 0; frame < 40; ++frame) {
        std::vector<float> depth(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            if (share(random) < 0.08f) level[i] = static_cast<int>(3.0f * share(random));
            depth[i] =
                share(random) < 0.05f ? 0.0f : 1.0f + 0.15f * static_cast<float>(level[i]) + jitter(random);
        }
        depth_m.write(depth);
        filtered_m.write(depth);
        judge.launch(eight_pixels_each(shape), depth_m, filtered_m, mean_m, frames, other_m, others, moving,
                     replaced, shape, noise, quantisation, sigmas, least);
        const auto left = depth_m.read(), left_filtered = filtered_m.read(), means = mean_m.read();
        const auto counts = frames.read(), moved = moving.read(), changed = replaced.read();
        for (std::size_t i = 0; i < pixels; ++i) {
            reference::StillPixel& pixel = expected[i];
            reference::add_depth(pixel, depth[i], noise, quantisation, sigmas, least);
            ASSERT_EQ(counts[i], pixel.frames) << frame << " " << i;
            ASSERT_EQ(moved[i] != 0, pixel.moving) << frame << " " << i;
            ASSERT_EQ(changed[i] != 0, pixel.replaced) << frame << " " << i;
            ASSERT_NEAR(means[i], pixel.mean_m, 1e-5f);
            ASSERT_EQ(left[i], pixel.moving ? 0.0f : depth[i]);
            ASSERT_EQ(left_filtered[i], left[i]);
            moves += pixel.moving;
            replacements += pixel.replaced;
        }
    }
    EXPECT_GT(moves, 1000);
    EXPECT_GT(replacements, 1000);
}

}  // namespace
}  // namespace touchstone
