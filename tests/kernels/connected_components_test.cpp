#include "pipeline/connected_components.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

#include "tests/reference/connected_components.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using Members = std::vector<std::uint8_t>;

struct Scene {
    int width_px, height_px;
    Members members;
    std::vector<float> depth_m;
};

Scene paint(int width_px, int height_px, const std::function<int(int, int)>& member) {
    Scene scene{width_px, height_px, {}, {}};
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) scene.members.push_back(static_cast<std::uint8_t>(member(x, y)));
    }
    scene.depth_m.assign(scene.members.size(), 1.0f);
    return scene;
}

/// Compares labels after numbering all components in the order of find(): that of their first pixels, which
/// is also the flood fill's. Then every sum.
void expect_the_flood_fills_components(const Scene& scene) {
    const Device device(DeviceConfig{});
    const MapShape shape = make_map_shape({1, 1, 0, 0, scene.width_px, scene.height_px, {0, 0}});
    const ConnectedComponentsConfig config;
    ConnectedComponents components(device, config, shape);
    Buffer<std::uint8_t> members(device, test::padded<std::uint8_t>(shape, scene.members));
    Buffer<float> depth(device, test::padded<float>(shape, scene.depth_m));
    Buffer<std::uint8_t> mask(device, map_pixels(shape));
    Buffer<int> labels_map(device, map_pixels(shape));
    const ConnectionParams params{config.noise, config.gap_sigmas, config.gap_per_m};
    const reference::FloodResult expected =
        reference::flood_fill(scene.members, scene.depth_m, scene.width_px, scene.height_px, params);

    const std::vector<Component>& found = components.find(members, depth);
    ASSERT_EQ(found.size(), expected.components.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const reference::FloodComponent& c = expected.components[i];
        ASSERT_EQ(found[i].pixels, c.pixels) << i;
        ASSERT_EQ(found[i].seeds, c.seeds) << i;
        ASSERT_EQ(found[i].unknowns, c.unknowns) << i;
        ASSERT_EQ(found[i].expected, c.expected) << i;
        ASSERT_EQ(found[i].box.min_x_px, c.min_x) << i;
        ASSERT_EQ(found[i].box.min_y_px, c.min_y) << i;
        ASSERT_EQ(found[i].box.max_x_px, c.max_x) << i;
        ASSERT_EQ(found[i].box.max_y_px, c.max_y) << i;
        // Depths are summed in whole millimetres.
        ASSERT_NEAR(found[i].mean_depth_m, c.depth_sum_m / c.pixels, 0.00051) << i;
    }
    std::vector<int> numbers(found.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    components.number(numbers, labels_map, mask);
    const std::vector<int> labels = test::cropped(shape, labels_map.read());
    EXPECT_EQ(labels, expected.labels);
    const Members masked = test::cropped(shape, mask.read());
    for (std::size_t i = 0; i < labels.size(); ++i) ASSERT_EQ(masked[i], labels[i] >= 0 ? 255 : 0);
}

TEST(ConnectedComponents, RandomMapsOfAnySize) {
    std::mt19937 random(3);
    for (const auto& [width, height] : {std::pair{64, 48}, {75, 37}, {7, 90}, {1, 1}, {16, 16}, {193, 130}}) {
        for (const unsigned share : {20u, 55u, 63u, 90u}) {
            expect_the_flood_fills_components(paint(width, height, [&](int, int) {
                return random() % 100 < share ? static_cast<int>(1 + random() % 7) : 0;
            }));
        }
    }
}

TEST(ConnectedComponents, RandomDepthsPartNeighbours) {
    std::mt19937 random(5);
    Scene scene = paint(130, 77, [&](int, int) { return random() % 10 < 8 ? 2 : 0; });
    for (float& z : scene.depth_m) z = 0.8f + 0.02f * static_cast<float>(random() % 3);
    expect_the_flood_fills_components(scene);
}

/// Depths one step apart are connected, two steps are not: three links of a square need not imply the fourth.
TEST(ConnectedComponents, DepthsThatAreConnectedOnlyThroughOthers) {
    std::mt19937 random(6);
    Scene scene = paint(130, 77, [&](int, int) { return random() % 10 < 9 ? 1 : 0; });
    for (float& z : scene.depth_m) z = 0.8f + 0.008f * static_cast<float>(random() % 4);
    expect_the_flood_fills_components(scene);
}

TEST(ConnectedComponents, EmptyAndFullPictures) {
    expect_the_flood_fills_components(paint(100, 50, [](int, int) { return 0; }));
    expect_the_flood_fills_components(paint(640, 480, [](int, int) { return 1; }));
    expect_the_flood_fills_components(paint(641, 479, [](int, int) { return 3; }));
}

TEST(ConnectedComponents, SinglePixelsAndACheckerboard) {
    expect_the_flood_fills_components(paint(90, 60, [](int x, int y) { return (x + y) % 2; }));
    expect_the_flood_fills_components(
        paint(90, 60, [](int x, int y) { return x % 9 == 8 && y % 7 == 6 ? 2 : 0; }));
}

/// A comb opens upwards: its teeth meet only in the last row, so labels travel the whole way back.
TEST(ConnectedComponents, Combs) {
    expect_the_flood_fills_components(
        paint(120, 70, [](int x, int y) { return x % 2 == 0 || y == 69 ? 1 : 0; }));
    expect_the_flood_fills_components(
        paint(120, 70, [](int x, int y) { return y % 2 == 0 || x == 119 ? 1 : 0; }));
}

/// One arm that winds inwards, one pixel wide with one pixel between the turns.
TEST(ConnectedComponents, Spiral) {
    constexpr int size = 91;
    Members members(size * size, 0);
    const auto at = [&](int x, int y) -> std::uint8_t& {
        return members[static_cast<std::size_t>(y * size + x)];
    };
    const auto taken = [&](int x, int y) {
        return x < 0 || y < 0 || x >= size || y >= size || at(x, y) != 0;
    };
    const auto blocked = [&](int x, int y, int dx, int dy) {
        const bool two_ahead_inside =
            x + 2 * dx >= 0 && y + 2 * dy >= 0 && x + 2 * dx < size && y + 2 * dy < size;
        return taken(x + dx, y + dy) || (two_ahead_inside && at(x + 2 * dx, y + 2 * dy) != 0);
    };
    int x = 0, y = 0, dx = 1, dy = 0;
    at(x, y) = 1;
    for (int turns = 0; turns < 2;) {
        if (blocked(x, y, dx, dy)) {
            const int old = dx;
            dx = -dy, dy = old;
            ++turns;
            continue;
        }
        x += dx, y += dy;
        at(x, y) = 1;
        turns = 0;
    }
    Scene scene{size, size, members, std::vector<float>(members.size(), 2.0f)};
    ASSERT_GT(std::count(members.begin(), members.end(), 1), 3000);
    expect_the_flood_fills_components(scene);
}

/// A slope of 1.2 cm a pixel over 2 m is one surface; a hand 5 cm above a floor at 1 m is apart from it.
TEST(ConnectedComponents, DepthJoinsSlopesAndPartsAHandFromTheFloor) {
    Scene scene = paint(64, 48, [](int, int) { return 1; });
    for (std::size_t i = 0; i < scene.depth_m.size(); ++i)
        scene.depth_m[i] = 1.0f + 0.012f * static_cast<float>(i % 64);
    expect_the_flood_fills_components(scene);
    for (std::size_t i = 0; i < scene.depth_m.size(); ++i) {
        const bool hand = i % 64 > 20 && i % 64 < 40 && i / 64 > 10 && i / 64 < 30;
        scene.depth_m[i] = hand ? 0.95f : 1.0f;
    }
    expect_the_flood_fills_components(scene);
}

TEST(ConnectedComponents, DropsWhatTheCallerDrops) {
    const Device device(DeviceConfig{});
    const MapShape shape = make_map_shape({1, 1, 0, 0, 32, 16, {0, 0}});
    ConnectedComponents components(device, {}, shape);
    const Scene scene = paint(32, 16, [](int x, int) { return x < 4 || (x > 10 && x < 20) || x == 31; });
    Buffer<std::uint8_t> members(device, scene.members), mask(device, map_pixels(shape));
    Buffer<float> depth(device, scene.depth_m);
    Buffer<int> labels_map(device, map_pixels(shape));
    ASSERT_EQ(components.find(members, depth).size(), 3u);
    components.number(std::vector<int>{-1, 7, -1}, labels_map, mask);
    const std::vector<int> labels = labels_map.read();
    const Members masked = mask.read();
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const bool kept = i % 32 > 10 && i % 32 < 20;
        ASSERT_EQ(labels[i], kept ? 7 : -1);
        ASSERT_EQ(masked[i], kept ? 255 : 0);
    }
}

}  // namespace
}  // namespace touchstone
