#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "pipeline/pixel_region.hpp"
#include "pipeline/table_picture.hpp"
#include "tests/reference/listing_4_touch_map.hpp"
#include "tests/support/analytic_scene.hpp"

namespace touchstone::test {

/// A surface as depth and outward normal (facing the camera) along a ray.
struct Ground {
    DepthOfRay depth;
    std::function<Eigen::Vector3f(const Eigen::Vector3f&)> normal;  ///< at a point of it
};

inline Ground plane_ground(const Eigen::Vector3f& away_c, float distance_m) {
    return {plane(away_c, distance_m), [=](const Eigen::Vector3f&) { return Eigen::Vector3f(-away_c); }};
}
/// A ball seen from outside.
inline Ground ball_ground(const Eigen::Vector3f& center_m, float radius_m) {
    return {sphere(center_m, radius_m),
            [=](const Eigen::Vector3f& p) { return (p - center_m).normalized(); }};
}
/// A hollow seen from inside: the far side of a ball.
inline Ground bowl_ground(const Eigen::Vector3f& center_m, float radius_m) {
    const auto depth = [=](const Eigen::Vector3f& ray) {
        const float a = ray.squaredNorm(), b = ray.dot(center_m);
        const float c = center_m.squaredNorm() - radius_m * radius_m;
        return b * b - a * c > 0.0f ? (b + std::sqrt(b * b - a * c)) / a : 0.0f;
    };
    return {depth, [=](const Eigen::Vector3f& p) { return (center_m - p).normalized(); }};
}

/// A shaft between two balls, metres.
struct Cone {
    Eigen::Vector3f a, b;
    float radius_a, radius_b;
};

/// Distance from its skin, up to the small angle of its sides.
inline float distance(const Cone& cone, const Eigen::Vector3f& p) {
    const Eigen::Vector3f along = cone.b - cone.a;
    const float share = std::clamp((p - cone.a).dot(along) / along.squaredNorm(), 0.0f, 1.0f);
    return (p - cone.a - share * along).norm() - (cone.radius_a + share * (cone.radius_b - cone.radius_a));
}

/// Depth along the ray K^-1 [u, 1] at which it meets the cone, 0 where it does not; by sphere tracing.
inline float depth_of(const Cone& cone, const Eigen::Vector3f& ray) {
    const Eigen::Vector3f direction = ray.normalized();
    const float reach = (cone.b - cone.a).norm() + cone.radius_a + cone.radius_b;
    if ((cone.a - cone.a.dot(direction) * direction).norm() > reach) return 0.0f;
    float t = std::max(0.0f, cone.a.norm() - reach);
    for (int i = 0; i < 200; ++i) {
        const float step = distance(cone, t * direction);
        if (step < 1e-6f) return t / ray.norm();
        if (step > 2.0f * reach) return 0.0f;
        t += 0.95f * step;
    }
    return distance(cone, t * direction) < 1e-4f ? t / ray.norm() : 0.0f;
}

/// A part of a Kinect's picture: 240 x 200 pixels around the optical axis.
inline Intrinsics cropped_kinect() { return {575.8f, 575.8f, 119.5f, 99.5f, 240, 200, {0, 0}}; }

/// A background with round cones over it, as the touch stages see it.
class FingerScene {
  public:
    explicit FingerScene(const Ground& ground) {
        background.intrinsics = k;
        background.depth_m = render_depth_m(k, ground.depth);
        for (int y = 0; y < k.height_px; ++y)
            for (int x = 0; x < k.width_px; ++x)
                background.normals_c.push_back(ground.normal(background.vertex(x, y)));
        live_m = background.depth_m;
    }

    void add(const Cone& cone) {
        add_depth([&](const Eigen::Vector3f& ray) { return depth_of(cone, ray); });
    }
    void add_depth(const DepthOfRay& surface) {
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) {
                const float depth = surface(pixel_ray(k, x, y));
                float& z = live_m[background.index(x, y)];
                if (depth > 0.0f) z = std::min(z, depth);
            }
        }
    }
    /// A finger whose pad is `gap_m` over the surface point `touched_m`, and a hand behind it. Directions
    /// point from the tip to the hand.
    void add_hand(const Eigen::Vector3f& touched_m, const Eigen::Vector3f& normal,
                  const Eigen::Vector3f& axis, float radius_m, float gap_m) {
        const Eigen::Vector3f tip = touched_m + (gap_m + radius_m) * normal;
        const Eigen::Vector3f knuckle = tip + 0.075f * axis.normalized();
        add({tip, knuckle, radius_m, 1.3f * radius_m});
        add({knuckle + 0.02f * axis.normalized(), knuckle + 0.09f * axis.normalized(), 0.028f, 0.03f});
    }
    /// Noise of the sensor along the rays, steps of 1/8 px disparity.
    void add_noise(unsigned seed) {
        std::mt19937 random(seed);
        std::normal_distribution<float> jitter(0.0f, 0.36f);
        const float steps_m = 8.0f * 0.075f * k.fx_px;
        for (float& z : live_m) z = steps_m / std::round(steps_m / z + jitter(random));
    }
    /// Everything that stands out by 5 mm is foreground. Call last.
    void finish() {
        mask.assign(live_m.size(), 0);
        const TouchMapParams params{noise, 0.018f, 2.0f, {0, 0}};
        const auto heights = reference::touch_map(live_m, mask, background, params);
        shape = make_map_shape(k);
        const std::size_t pixels = map_pixels(shape);
        padded_live.assign(pixels, 0.0f), padded_height.assign(pixels, UNKNOWN_HEIGHT_M);
        padded_background.assign(pixels, 0.0f), padded_normals.assign(3 * pixels, 0.0f),
            padded_mask.assign(pixels, 0);
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) {
                const std::size_t from = background.index(x, y), to = map_index(shape, x, y);
                padded_live[to] = live_m[from];
                padded_height[to] = heights[from].height_m;
                padded_background[to] = background.depth_m[from];
                for (int axis = 0; axis < 3; ++axis)
                    padded_normals[static_cast<std::size_t>(axis) * pixels + to] =
                        background.normals_c[from][axis];
                padded_mask[to] = heights[from].height_m > 0.005f && live_m[from] > 0.0f ? 255 : 0;
            }
        }
    }
    TablePicture picture() const {
        return {k, shape, noise, padded_live, padded_height, padded_background, padded_normals, padded_mask};
    }
    PixelRegion whole() const { return {0, 0, k.width_px, k.height_px}; }

    Intrinsics k = cropped_kinect();
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};
    MapShape shape{};
    reference::OrientedPicture background;
    std::vector<float> live_m;
    std::vector<std::uint8_t> mask, padded_mask;
    std::vector<float> padded_live, padded_height, padded_background, padded_normals;
};

}  // namespace touchstone::test
