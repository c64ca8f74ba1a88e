#include "tests/reference/listing_4_touch_map.hpp"

#include <gtest/gtest.h>

#include "pipeline/touch_map.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// A tilted plane with a ball on it as background, with holes, over which a smaller ball hovers.
class Listing4 : public testing::Test {
  protected:
    Listing4() {
        background.intrinsics = k;
        background.depth_m = test::render_depth_m(k, scene);
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) background.normals_c.push_back(normal_at(x, y));
        }
        for (std::size_t u = 0; u < live_m.size(); ++u) {
            if (u % 7 == 3) background.depth_m[u] = 0.0f;
            if (u % 11 == 5) live_m[u] = 0.0f;
            mask[u] = live_m[u] + 0.002f < background.depth_m[u] ? 255 : 0;
        }
    }

    Vector3f normal_at(int x, int y) const {
        const Vector3f v = background.vertex(x, y);
        if ((v - ball_m).norm() < ball_radius_m + 1e-4f) return (v - ball_m).normalized();
        return -plane_n;
    }

    SurfacePrediction uploaded_background() {
        SurfacePrediction prediction(device, shape);
        prediction.depth_m.write(test::padded<float>(shape, background.depth_m));
        std::vector<float> planes;
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<float> picture;
            for (const Vector3f& n : background.normals_c) picture.push_back(n[axis]);
            std::ranges::copy(test::padded<float>(shape, picture), std::back_inserter(planes));
        }
        prediction.normals_c.write(planes);
        return prediction;
    }

    /// Where heights are promised.
    bool is_in_or_beside_mask(std::size_t u) const {
        const int x = static_cast<int>(u) % k.width_px, y = static_cast<int>(u) / k.width_px;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, k.height_px - 1); ++j)
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, k.width_px - 1); ++i)
                if (mask[background.index(i, j)] != 0) return true;
        return false;
    }

    TouchMap map_on_device(const std::vector<PixelRegion>& boxes) {
        const SurfacePrediction prediction = uploaded_background();
        const Buffer<float> live(device, test::padded<float>(shape, live_m));
        const Buffer<std::uint8_t> masked(device, test::padded<std::uint8_t>(shape, mask));
        TouchMap map(device, shape);
        TouchMapping(device, config, k).update(live, masked, prediction, boxes, map);
        return map;
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(192, 160);
    MapShape shape = make_map_shape(k);
    Vector3f plane_n = Vector3f(0.2f, 0.5f, 1.0f).normalized();
    Vector3f ball_m{-0.12f, 0.05f, 0.86f};
    float ball_radius_m = 0.12f;
    test::DepthOfRay scene = test::both(test::plane(plane_n, 0.8f), test::sphere(ball_m, ball_radius_m));
    std::vector<float> live_m =
        test::render_depth_m(k, test::both(scene, test::both(test::sphere({0.1f, 0.02f, 0.87f}, 0.03f),
                                                             test::sphere({-0.1f, 0.05f, 0.74f}, 0.03f))));
    std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(live_m.size());
    reference::OrientedPicture background;
    TouchMapConfig config;
};

TEST_F(Listing4, HeightsAndFlagsAreThoseOfTheReference) {
    const TouchMap map = map_on_device({{0, 0, k.width_px, k.height_px}});
    const TouchMapParams params{config.noise, config.finger_thickness_m, config.threshold_sigmas, {0, 0}};
    const auto expected = reference::touch_map(live_m, mask, background, params);
    const std::vector<float> height_m = test::cropped(shape, map.height_m.read());
    const std::vector<std::uint8_t> touch = test::cropped(shape, map.touch.read());
    int touched = 0, off = 0;
    for (std::size_t u = 0; u < expected.size(); ++u) {
        touched += expected[u].touches;
        // A foot point on the border of two pixels may fall to either side in the two computations.
        const bool height_is_off = std::abs(height_m[u] - expected[u].height_m) > 2e-5f;
        off += (height_is_off && is_in_or_beside_mask(u)) || (touch[u] == 255) != expected[u].touches;
        EXPECT_TRUE(touch[u] == 0 || touch[u] == 255);
    }
    EXPECT_GT(touched, 50);
    EXPECT_LE(off, 3) << "pixels that differ by more than 0.02 mm or in their flag";
}

TEST_F(Listing4, HeightIsTheDistanceToTheSurfaceNotAlongTheRay) {
    const TouchMap map = map_on_device({{0, 0, k.width_px, k.height_px}});
    const std::vector<float> height_m = test::cropped(shape, map.height_m.read());
    int checked = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const std::size_t u = background.index(x, y);
            const Vector3f v = live_m[u] * test::pixel_ray(k, x, y);
            const bool over_plane = v.x() > 0.08f && mask[u] != 0;
            if (!over_plane || height_m[u] == UNKNOWN_HEIGHT_M) continue;
            EXPECT_NEAR(height_m[u], 0.8f - plane_n.dot(v), 1e-4f);
            ++checked;
        }
    }
    EXPECT_GT(checked, 50);
}

TEST_F(Listing4, OnlyTheBoxesAreWorkedOnAndTheRestHasNoTouch) {
    const TouchMap everywhere = map_on_device({{0, 0, k.width_px, k.height_px}});
    const PixelRegion box{101, 60, 141, 110};
    const TouchMap boxed = map_on_device({box});
    const std::vector<std::uint8_t> all = everywhere.touch.read(), some = boxed.touch.read();
    int inside = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const std::size_t u = map_index(shape, x, y);
            if (box.contains(x, y)) {
                EXPECT_EQ(some[u], all[u]);
                inside += some[u] != 0;
            } else if (!grown(box, 8, k.width_px, k.height_px).contains(x, y)) {
                EXPECT_EQ(some[u], 0);
            }
        }
    }
    EXPECT_GT(inside, 20);
}

TEST_F(Listing4, NarrowHolesOfTheBackgroundAreBridgedWideOnesAreUnknown) {
    for (int y = 0; y < k.height_px; ++y)
        for (int x = 0; x < 60; ++x) background.depth_m[background.index(x, y)] = 0.0f;
    std::ranges::fill(mask, std::uint8_t{255});
    const TouchMap map = map_on_device({{0, 0, k.width_px, k.height_px}});
    const std::vector<float> height_m = test::cropped(shape, map.height_m.read());
    for (int y = 8; y < k.height_px - 8; ++y) {
        for (int x = 8; x < k.width_px - 8; ++x) {
            const std::size_t u = background.index(x, y);
            if (live_m[u] <= 0.0f || x < 50) {
                EXPECT_EQ(height_m[u], UNKNOWN_HEIGHT_M);
            } else if (x > 70) {
                EXPECT_NE(height_m[u], UNKNOWN_HEIGHT_M);
            }
        }
    }
}

TEST_F(Listing4, HeightsAreKnownInTheMaskAndBesideItOnly) {
    std::ranges::fill(background.depth_m, 1.0f);
    std::ranges::fill(live_m, 0.99f);
    std::ranges::fill(mask, std::uint8_t{0});
    constexpr int mask_x = 96, mask_y = 80;
    mask[background.index(mask_x, mask_y)] = 255;
    const TouchMap map = map_on_device({{0, 0, k.width_px, k.height_px}});
    const std::vector<float> height_m = test::cropped(shape, map.height_m.read());
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const int far_px = std::max(std::abs(x - mask_x), std::abs(y - mask_y));
            const float height = height_m[background.index(x, y)];
            if (far_px <= 1) {
                EXPECT_LT(height, 0.02f) << x << " " << y;
            } else if (far_px > 8) {
                EXPECT_EQ(height, UNKNOWN_HEIGHT_M) << x << " " << y;
            }
        }
    }
}

}  // namespace
}  // namespace touchstone
