#include "tests/reference/sample_weights.hpp"

#include <gtest/gtest.h>
#include <random>

#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/sample_weights.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

class SampleWeights : public testing::Test {
  protected:
    /// Weights of a picture, row-major.
    std::vector<std::uint8_t> weigh(const std::vector<std::uint16_t>& depth_mm,
                                    const SampleWeightConfig& config = {}) {
        DepthMapConversion(device, {}, k).convert({depth_mm, k}, live);
        SampleWeighting weighting(device, config, k);
        return test::cropped(live.shape, weighting.weigh(live, mask).read());
    }
    std::vector<std::uint16_t> wall_mm(std::uint16_t depth_mm) const {
        return std::vector<std::uint16_t>(static_cast<std::size_t>(k.width_px * k.height_px), depth_mm);
    }
    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * k.width_px + x); }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(320, 203);
    LiveMaps live{device, make_map_shape(k)};
    Buffer<std::uint8_t> mask = [&] {
        Buffer<std::uint8_t> map(device, map_pixels(live.shape));
        map.fill(0);
        return map;
    }();
};

TEST_F(SampleWeights, AgreeWithTheReferenceOnANoisyScene) {
    const auto surface = test::both(test::plane(Eigen::Vector3f(0.1f, 0.9f, 0.4f).normalized(), 0.5f),
                                    test::sphere({0.05f, 0.0f, 0.8f}, 0.12f));
    std::vector<std::uint16_t> depth_mm = test::to_mm(test::render_depth_m(k, surface));
    std::mt19937 random(7);
    for (std::uint16_t& mm : depth_mm) {
        if (random() % 17 == 0) mm = 0;
        if (random() % 29 == 0) mm = static_cast<std::uint16_t>(400 + random() % 800);
    }
    const SampleWeightConfig config{.most = 20};
    const std::vector<std::uint8_t> got = weigh(depth_mm, config);
    const reference::Picture depth{k.width_px, k.height_px, test::cropped(live.shape, live.depth_m.read())};
    const std::vector<float> normals = live.normals_c.read();
    std::vector<int> seen(21, 0);
    int differing = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            Eigen::Vector3f n;
            for (int axis = 0; axis < 3; ++axis)
                n[axis] = normals[static_cast<std::size_t>(axis) * map_pixels(live.shape) +
                                  map_index(live.shape, x, y)];
            const int expected =
                reference::sample_weight(depth, k, n, x, y, make_sample_weight_params(config));
            ASSERT_NEAR(got[at(x, y)], expected, expected > 1 ? 1 : 0) << x << " " << y;
            differing += got[at(x, y)] != expected;
            ++seen[got[at(x, y)]];
        }
    }
    EXPECT_LT(differing, k.width_px * k.height_px / 1000) << "rounding at a half may go either way";
    for (const int weight : {0, 1, 5, 10, 20}) EXPECT_GT(seen[static_cast<std::size_t>(weight)], 0) << weight;
}

TEST_F(SampleWeights, FollowTheInverseVarianceOfAFacingWall) {
    const auto center = at(k.width_px / 2, k.height_px / 2);
    EXPECT_EQ(weigh(wall_mm(1000))[center], 8);
    EXPECT_EQ(weigh(wall_mm(600))[center], 8) << "nearer than the reference: clamped";
    // sigma is 1.88 mm at 1 m and 3.50 mm at 1.5 m: 8 (1.88 / 3.50)^2 = 2.3; at 3 m 14 mm.
    EXPECT_EQ(weigh(wall_mm(1500))[center], 2);
    EXPECT_EQ(weigh(wall_mm(3000))[center], 1);
    EXPECT_EQ(weigh(wall_mm(1000), {.most = 1})[center], 1) << "alike";
}

TEST_F(SampleWeights, GrazingSurfacesAreLeftOut) {
    // The middle column looks along z: the plane y = -h is seen at the angle of the row.
    const auto at_angle = [&](float degrees) {
        const float radians = degrees * 3.14159265f / 180.0f;
        const auto tilted = test::plane({0.0f, std::sin(radians), std::cos(radians)}, std::cos(radians));
        return weigh(test::to_mm(test::render_depth_m(k, tilted)))[at(k.width_px / 2, k.height_px / 2)];
    };
    EXPECT_EQ(at_angle(0.0f), 8);
    EXPECT_GT(at_angle(60.0f), 3);
    EXPECT_LT(at_angle(75.0f), at_angle(60.0f));
    EXPECT_GT(at_angle(75.0f), 0);
    EXPECT_EQ(at_angle(84.0f), 0);
}

TEST_F(SampleWeights, PixelsBetweenTheSidesOfAnEdgeAreLeftOutAndThinThingsKept) {
    std::vector<std::uint16_t> depth_mm = wall_mm(2000);
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 100; x < 150; ++x) depth_mm[at(x, y)] = 1000;
        depth_mm[at(150, y)] = 1400;  // flies
        depth_mm[at(220, y)] = 1000;  // a wire
    }
    const std::vector<std::uint8_t> weights = weigh(depth_mm);
    EXPECT_EQ(weights[at(150, 100)], 0);
    EXPECT_GT(weights[at(149, 100)], 0);
    EXPECT_GT(weights[at(151, 100)], 0);
    EXPECT_EQ(weights[at(220, 100)], 1) << "no normal, yet seen";
}

TEST_F(SampleWeights, MaskedPixelsHolesAndPictureBorders) {
    std::vector<std::uint16_t> depth_mm = wall_mm(1000);
    depth_mm[at(40, 40)] = 0;
    std::vector<std::uint8_t> picture(depth_mm.size(), 0);
    picture[at(60, 60)] = 255;
    mask.write(test::padded<std::uint8_t>(live.shape, picture));
    const std::vector<std::uint8_t> weights = weigh(depth_mm);
    EXPECT_EQ(weights[at(40, 40)], 0);
    EXPECT_EQ(weights[at(60, 60)], 0);
    EXPECT_EQ(weights[at(61, 60)], 8);
    EXPECT_EQ(weights[at(0, 0)], 7) << "a corner is seen at 31 degrees and counts";
}

TEST_F(SampleWeights, LargestWeightOutOfRangeIsRefused) {
    EXPECT_THROW(SampleWeighting(device, {.most = 0}, k), Error);
    EXPECT_THROW(SampleWeighting(device, {.most = 256}, k), Error);
}

}  // namespace
}  // namespace touchstone
