#include "tests/reference/moving_parts.hpp"

#include <gtest/gtest.h>
#include <random>

#include "pipeline/kernel_program.hpp"
#include "pipeline/moving_parts.hpp"
#include "pipeline/types.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using reference::Grid;

constexpr reference::FreeSpaceParams space{{0.0012f, 0.0019f, 0.4f, 0.0001f}, 0.04f, 32, 4, 30};

class MovingPartsKernels : public testing::TestWithParam<std::pair<int, int>> {
  protected:
    int width_px = GetParam().first, height_px = GetParam().second;
    Intrinsics k{150.0f,
                 150.0f,
                 0.5f * static_cast<float>(width_px),
                 0.5f * static_cast<float>(height_px),
                 width_px,
                 height_px,
                 {0, 0}};
    Device device{DeviceConfig{}};
    MapShape shape = make_map_shape(k);
    Program program = load_kernel_program(device, "moving_parts.cl");
    /// Oblique, in the middle of one side of the cube of 1.28 m.
    RigidTransform T_g_c = Eigen::Translation3f(0.64f, 0.6f, -0.3f) *
                           Eigen::AngleAxisf(0.2f, Eigen::Vector3f(1.0f, 2.0f, 0.5f).normalized());
    std::mt19937 random{7};

    template <class T>
    Buffer<T> upload(const Grid<T>& grid) {
        return {device, test::padded<T>(shape, grid.values)};
    }
    /// A slanted wall with a near box before it, and single holes.
    Grid<float> depths() {
        Grid<float> grid{width_px, height_px, {}};
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                const bool box = 3 * x > width_px && 3 * x < 2 * width_px && 2 * y > height_px;
                const float wall_m = 1.1f + 0.3f * static_cast<float>(x) / static_cast<float>(width_px);
                grid.values.push_back(random() % 400 == 0 ? 0.0f : box ? 0.7f : wall_m);
            }
        }
        return grid;
    }
    Grid<std::uint8_t> some_codes(const Grid<float>& live) {
        Grid<std::uint8_t> codes{width_px, height_px, {}};
        for (const float z : live.values)
            codes.values.push_back(z > 0.0f ? static_cast<std::uint8_t>(random() % 7)
                                            : std::uint8_t{ASSOCIATION_NO_LIVE_DEPTH});
        return codes;
    }
    static RigidTransform moved_a_little() {
        return Eigen::Translation3f(0.02f, -0.01f, 0.01f) *
               RigidTransform(Eigen::AngleAxisf(0.02f, Eigen::Vector3f::UnitY()));
    }
    std::vector<std::uint8_t> counts() {
        std::vector<std::uint8_t> values(32U * 32U * 32U);
        for (auto& value : values) value = static_cast<std::uint8_t>(random() % 31);
        return values;
    }
};

/// Equal but for one cell in a thousand, where a rounding falls on the other side of a limit.
TEST_P(MovingPartsKernels, FreeSpaceAgreesWithTheReference) {
    const Grid<float> depth = depths();
    Grid<std::uint8_t> moving{width_px, height_px, std::vector<std::uint8_t>(depth.values.size(), 0)};
    for (std::size_t i = 0; i < moving.values.size() / 3; ++i) moving.values[i] = 255;
    const std::vector<std::uint8_t> before = counts(), taken_before = counts();
    std::vector<std::uint8_t> taken_now = counts();
    for (auto& taken : taken_now) taken = taken > 15 ? 1 : 0;
    const auto depth_map = upload(depth);
    const auto moving_map = upload(moving);
    Buffer<std::uint8_t> seen_free(device, before), seen_taken(device, taken_before);
    Buffer<float> windows(device, 7 * (map_pixels(shape) + 64));
    program.kernel("copy_windows").launch(eight_pixels_each(shape), depth_map, windows, shape, 0);
    for (int level = 1; level < 7; ++level)
        program.kernel("double_windows").launch(eight_pixels_each(shape), windows, shape, level);
    program.kernel("remember_free_space")
        .launch({{4, 32, 32}, {4, 1, 1}}, depth_map, moving_map, windows,
                Buffer<std::uint8_t>(device, taken_now), seen_free, seen_taken, space.cell_m,
                space.cells_per_side, space.most_frames, space.noise, k, shape, to_pose(T_g_c.inverse()));
    const std::vector<std::uint8_t> after = seen_free.read(), taken_after = seen_taken.read();
    int more = 0, less = 0, differing = 0;
    for (int i = 0; i < 32 * 32 * 32; ++i) {
        const Eigen::Vector3f cell(static_cast<float>(i % 32), static_cast<float>(i / 32 % 32),
                                   static_cast<float>(i / 1024));
        const Eigen::Vector3f centre_c = T_g_c.inverse() * (space.cell_m * (cell.array() + 0.5f).matrix());
        const auto at = static_cast<std::size_t>(i);
        const reference::CellCounts expected = reference::remember_free_space(
            depth, moving, space, k, centre_c, taken_now[at] != 0, {before[at], taken_before[at]});
        more += expected.seen_free > before[at], less += expected.seen_free < before[at];
        differing += after[at] != expected.seen_free || taken_after[at] != expected.seen_taken;
    }
    EXPECT_LE(differing, 32);
    if (width_px >= 96) {
        EXPECT_GT(more, 300);
        EXPECT_GT(less, 50);
    }
}

/// Equal but for one cell in a thousand, at whose border a point lies.
TEST_P(MovingPartsKernels, CellsWithASurfaceAgreeWithTheReference) {
    const Grid<float> depth = depths();
    Buffer<std::uint8_t> taken(device, std::vector<std::uint8_t>(32U * 32U * 32U, 0));
    program.kernel("mark_taken")
        .launch(eight_pixels_each(shape), upload(depth), taken, shape, k, to_pose(T_g_c), space.cell_m,
                space.cells_per_side);
    std::vector<std::uint8_t> expected(32U * 32U * 32U, 0);
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            if (depth.at(x, y) <= 0.0f) continue;
            const auto cell =
                reference::cell_index(space, T_g_c * reference::back_project(k, x, y, depth.at(x, y)));
            if (cell) expected[*cell] = 1;
        }
    }
    const std::vector<std::uint8_t> found = taken.read();
    int differing = 0;
    for (std::size_t i = 0; i < found.size(); ++i) differing += found[i] != expected[i];
    EXPECT_LE(differing, 32);
    if (width_px >= 96) {
        EXPECT_GT(std::ranges::count(expected, 1), 200);
    }
}

/// Equal but for one pixel in fifty: borders of cells and steps of depth.
TEST_P(MovingPartsKernels, MembersAgreeWithTheReference) {
    const Grid<float> live = depths(), before = depths();
    const Grid<std::uint8_t> codes = some_codes(live);
    std::vector<std::uint8_t> seen_free = counts();
    for (auto& count : seen_free) count = count < 8 ? 0 : count;
    const std::vector<std::uint8_t> seen_taken = counts();
    const RigidTransform T_b_c = moved_a_little();
    std::array<int, 4> seen{};
    for (const auto& [into_unknown, young_frames] : {std::pair{0, 0}, {1, 0}, {0, 12}}) {
        Buffer<std::uint8_t> members(device, map_pixels(shape)), young(device, map_pixels(shape));
        program.kernel("mark_moving")
            .launch(eight_pixels_each(shape), upload(codes), upload(live),
                    Buffer<std::uint8_t>(device, seen_free), Buffer<std::uint8_t>(device, seen_taken),
                    upload(before), members, young, shape, k, to_pose(T_g_c), to_pose(T_b_c), space.cell_m,
                    space.cells_per_side, space.enough_frames, young_frames, into_unknown, space.noise);
        const std::vector<std::uint8_t> found = test::cropped(shape, members.read());
        const std::vector<std::uint8_t> found_young = test::cropped(shape, young.read());
        int differing = 0, are_young = 0;
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) {
                const bool is_young =
                    reference::is_young(seen_taken, space, young_frames, live.at(x, y),
                                        T_g_c * reference::back_project(k, x, y, live.at(x, y)));
                const int expected =
                    reference::mark_moving(codes.at(x, y), live.at(x, y), x, y, seen_free, before, space,
                                           into_unknown != 0, is_young, k, T_g_c, T_b_c);
                const auto at = static_cast<std::size_t>(y * width_px + x);
                ++seen[static_cast<std::size_t>(expected)];
                are_young += is_young ? 1 : 0;
                differing += found[at] != expected || found_young[at] != (is_young ? 255 : 0);
            }
        }
        EXPECT_LE(differing, width_px * height_px / 50);
        if (width_px >= 96) {
            EXPECT_EQ(are_young > 500, young_frames > 0);
        }
    }
    if (width_px >= 96) {
        EXPECT_GT(*std::ranges::min_element(seen), 20);
    }
}

/// Equal but for one pixel in fifty: what lies between two pixels of the last frame.
TEST_P(MovingPartsKernels, HeldPixelsAgreeWithTheReference) {
    const Grid<float> live = depths(), last = depths();
    const Grid<std::uint8_t> codes = some_codes(live);
    Grid<std::uint8_t> members{width_px, height_px, {}}, last_held = members;
    Grid<int> labels{width_px, height_px, {}};
    for (std::size_t i = 0; i < live.values.size(); ++i) {
        members.values.push_back(static_cast<std::uint8_t>(random() % 4));
        labels.values.push_back(static_cast<int>(random() % 4) - 2);
        last_held.values.push_back(random() % 3 == 0 ? static_cast<std::uint8_t>(random() % 100) : 0);
    }
    const RigidTransform T_p_c = moved_a_little();
    Buffer<std::uint8_t> held(device, map_pixels(shape)), mask(device, map_pixels(shape));
    program.kernel("hold_moving")
        .launch(eight_pixels_each(shape), upload(labels), upload(members), upload(codes), upload(live),
                upload(last), upload(last_held), held, mask, shape, k, to_pose(T_p_c), 100, space.noise);
    const std::vector<std::uint8_t> found = test::cropped(shape, held.read());
    const std::vector<std::uint8_t> masked = test::cropped(shape, mask.read());
    int differing = 0, passed_on = 0;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const int expected =
                reference::hold_moving(labels.at(x, y), members.at(x, y), codes.at(x, y), live.at(x, y), x, y,
                                       last, last_held, k, T_p_c, 100, space.noise);
            const auto at = static_cast<std::size_t>(y * width_px + x);
            differing += found[at] != expected;
            passed_on += expected > 0 && expected < 99;
            ASSERT_EQ(masked[at], found[at] != 0 ? 255 : 0);
        }
    }
    EXPECT_LE(differing, width_px * height_px / 50);
    if (width_px >= 96) {
        EXPECT_GT(passed_on, 100);
    }
}

TEST_P(MovingPartsKernels, TheMaskIsWidenedByRows) {
    Grid<std::uint8_t> mask{width_px, height_px, {}};
    for (int i = 0; i < width_px * height_px; ++i) mask.values.push_back(random() % 300 == 0 ? 255 : 0);
    Buffer<std::uint8_t> wide(device, map_pixels(shape));
    program.kernel("widen_columns").launch(eight_pixels_each(shape), upload(mask), wide, shape, 3);
    const std::vector<std::uint8_t> found = test::cropped(shape, wide.read());
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            int expected = 0;
            for (int j = -3; j <= 3; ++j) expected |= mask.at(x, y + j);
            ASSERT_EQ(found[static_cast<std::size_t>(y * width_px + x)], expected) << x << " " << y;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, MovingPartsKernels,
                         testing::Values(std::pair{160, 120}, std::pair{96, 80}, std::pair{75, 37},
                                         std::pair{1, 1}));

}  // namespace
}  // namespace touchstone
