#include "tests/reference/foreground_segmentation.hpp"

#include <gtest/gtest.h>
#include <random>

#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/kernel_program.hpp"
#include "tests/reference/column_drift.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using reference::Grid;

MapShape shape_of(int width_px, int height_px) {
    return make_map_shape({1.0f, 1.0f, 0.0f, 0.0f, width_px, height_px, {0, 0}});
}

template <class T>
Buffer<T> upload(const Device& device, const Grid<T>& grid) {
    return {device, test::padded<T>(shape_of(grid.width_px, grid.height_px), grid.values)};
}

/// Depths about 1 m with steps of 5 cm, so that the model has edges, and holes.
Grid<float> random_depth(int width_px, int height_px, unsigned seed, unsigned holes_percent) {
    std::mt19937 random(seed);
    Grid<float> grid{width_px, height_px, {}};
    for (int i = 0; i < width_px * height_px; ++i) {
        const bool hole = random() % 100 < holes_percent;
        const float step_m = random() % 12 == 0 ? -0.05f : 0.0f;
        grid.values.push_back(hole ? 0.0f : 1.0f + step_m - 0.0005f * static_cast<float>(random() % 60));
    }
    return grid;
}

Grid<std::uint8_t> random_bytes(int width_px, int height_px, unsigned seed, const std::vector<int>& from) {
    std::mt19937 random(seed);
    Grid<std::uint8_t> grid{width_px, height_px, {}};
    for (int i = 0; i < width_px * height_px; ++i)
        grid.values.push_back(static_cast<std::uint8_t>(from[random() % from.size()]));
    return grid;
}

class SegmentationKernels : public testing::TestWithParam<std::pair<int, int>> {
  protected:
    int width_px = GetParam().first, height_px = GetParam().second;
    Device device{DeviceConfig{}};
    MapShape shape = shape_of(width_px, height_px);
    Program program = load_kernel_program(device, "foreground_segmentation.cl");
    LaunchSize half_tiles{
        {static_cast<std::size_t>(shape.pitch_px / 8), static_cast<std::size_t>(shape.rows_px / TILE_PX), 1}};
};

TEST_P(SegmentationKernels, CandidatesAgreeWithTheReference) {
    const CandidateParams params{{0.0012f, 0.0019f, 0.4f, 0.0001f}, 0.0008f, 4.0f, 0.02f, 0.99f};
    std::vector<int> seen(4, 0);
    for (const unsigned holes_percent : {10u, 93u}) {
        const Grid<float> live = random_depth(width_px, height_px, 1, 0);
        const Grid<float> model = random_depth(width_px, height_px, 2, holes_percent);
        const Grid<float> fallback = random_depth(width_px, height_px, 3, 50);
        const Grid<std::uint8_t> codes = random_bytes(width_px, height_px, 4, {0, 1, 2, 3, 3, 4, 5, 6});
        Buffer<std::uint8_t> members(device, map_pixels(shape));
        program.kernel("mark_candidates")
            .launch(eight_pixels_each(shape), upload(device, codes), upload(device, live),
                    upload(device, model), upload(device, fallback), members, shape, params);
        const std::vector<std::uint8_t> found = test::cropped(shape, members.read());
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                const int expected = reference::mark_candidate(codes, live, model, fallback, x, y, params);
                ASSERT_EQ(found[static_cast<std::size_t>(y * width_px + x)], expected) << x << " " << y;
                ++seen[static_cast<std::size_t>(expected)];
            }
        }
    }
    if (width_px * height_px > 1000) {
        EXPECT_GT(*std::ranges::min_element(seen), 20);
    }
}

TEST_P(SegmentationKernels, SupportedSeedsAgreeWithTheReference) {
    const Grid<std::uint8_t> members = random_bytes(width_px, height_px, 5, {0, 1, 2, 2, 3});
    const Grid<std::uint8_t> held = random_bytes(width_px, height_px, 14, {0, 0, 4, 5, 6});
    Buffer<std::uint8_t> supported(device, map_pixels(shape));
    program.kernel("keep_supported_seeds")
        .launch(eight_pixels_each(shape), upload(device, members), upload(device, held), supported, shape, 5);
    const std::vector<std::uint8_t> found = test::cropped(shape, supported.read());
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x)
            ASSERT_EQ(found[static_cast<std::size_t>(y * width_px + x)],
                      reference::keep_supported_seed(members, held, 5, x, y))
                << x << " " << y;
    }
}

TEST_P(SegmentationKernels, BackgroundMaskAgreesWithTheReference) {
    const Grid<float> live = random_depth(width_px, height_px, 6, 20);
    const Grid<float> model = random_depth(width_px, height_px, 7, 50);
    for (const int radius_px : {0, 3, 8}) {
        Grid<float> fallback = random_depth(width_px, height_px, 8, 50);
        Grid<std::uint8_t> held = random_bytes(width_px, height_px, 9, {0, 1, 4});
        std::vector<int> sparse(300, 0);
        sparse[0] = 255;
        const Grid<std::uint8_t> mask = random_bytes(width_px, height_px, 10, sparse);
        Buffer<std::uint8_t> wide(device, map_pixels(shape)), held_map = upload(device, held);
        Buffer<std::uint8_t> background_mask(device, map_pixels(shape));
        Buffer<float> fallback_map = upload(device, fallback);
        program.kernel("widen_rows")
            .launch(eight_pixels_each(shape), upload(device, mask), wide, shape, radius_px);
        program.kernel("mask_background")
            .launch(half_tiles, wide, upload(device, live), upload(device, model), held_map, background_mask,
                    fallback_map, shape, radius_px, 5);
        reference::mask_background(mask, live, model, held, fallback, radius_px, 5);
        EXPECT_EQ(test::cropped(shape, held_map.read()), held.values) << radius_px;
        const std::vector<float> fallback_m = test::cropped(shape, fallback_map.read());
        const std::vector<std::uint8_t> masked = test::cropped(shape, background_mask.read());
        for (std::size_t i = 0; i < masked.size(); ++i) {
            ASSERT_EQ(masked[i], held.values[i] != 0 ? 255 : 0) << i;
            ASSERT_NEAR(fallback_m[i], fallback.values[i], 1e-6f) << i;
        }
    }
}

/// Sums to 2e-6 1/m, which is a thousandth of a step of disparity.
TEST_P(SegmentationKernels, ColumnResidualsAgreeWithTheReference) {
    const Grid<float> live = random_depth(width_px, height_px, 11, 10);
    const Grid<float> model = random_depth(width_px, height_px, 12, 10);
    const Grid<std::uint8_t> excluded = random_bytes(width_px, height_px, 13, {0, 0, 0, 255});
    const DriftParams params{0.00145f, 1, 3, 0};
    const auto cells = static_cast<std::size_t>(DRIFT_ZONES * DRIFT_BINS * shape.pitch_px);
    Buffer<float> counts(device, cells), sums(device, cells);
    load_kernel_program(device, "column_drift.cl")
        .kernel("column_residuals")
        .launch({{static_cast<std::size_t>(shape.pitch_px / 8), DRIFT_ZONES, 1}, {2, DRIFT_ZONES, 1}},
                upload(device, live), upload(device, model), upload(device, excluded), counts, sums, shape,
                params);
    const std::vector<float> found = counts.read(), found_sums = sums.read();
    for (int zone = 0; zone < DRIFT_ZONES; ++zone) {
        for (int x = 0; x < width_px; ++x) {
            const reference::ResidualHistogram expected = reference::column_residuals(
                live.values, model.values, excluded.values, width_px, height_px, x, zone, params);
            for (int bin = 0; bin < DRIFT_BINS; ++bin) {
                const auto cell = static_cast<std::size_t>((zone * DRIFT_BINS + bin) * shape.pitch_px + x);
                ASSERT_EQ(found[cell], expected.counts[static_cast<std::size_t>(bin)]) << x << " " << bin;
                ASSERT_NEAR(found_sums[cell], expected.sums_per_m[static_cast<std::size_t>(bin)], 2e-6f);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, SegmentationKernels,
                         testing::Values(std::pair{96, 80}, std::pair{75, 37}, std::pair{1, 1},
                                         std::pair{160, 16}));

}  // namespace
}  // namespace touchstone
