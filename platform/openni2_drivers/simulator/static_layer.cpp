#include "platform/openni2_drivers/simulator/static_layer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone::sim {
namespace {

constexpr int tile_px = 16;

/// Marches along a ray; `widening` is how much wider the free space must grow per metre (0 for a single ray).
/// Gives the distance at which less than that is free.
float march(const Scene& scene, const Vec3& from_s, const Vec3& direction_s, float start_m, float widening) {
    float t = start_m;
    for (int i = 0; i < 256; ++i) {
        const float free = scene.distance(from_s + t * direction_s) - widening * t;
        if (free < 3e-6F) break;
        t += free / (1.0F + widening);
    }
    return t;
}

/// How far all rays of a tile run through free space.
float tile_start_m(const Scene& scene, const TableView& view, int left_px, int top_px) {
    const float half = 0.5F * tile_px;
    const Vec3 middle = view.ray_c(static_cast<float>(left_px) + half, static_cast<float>(top_px) + half);
    const float widening = 1.5F * half / view.intrinsics.fx_px;
    return march(scene, view.camera_s, view.rotation_s_c * middle.normalized(), 0.0F, widening);
}

/// Boards of wood: rings cut along the grain, with a seam every 14 cm.
Vec3 wood(const Vec3& p_s) {
    const float board = std::floor(p_s.y() / 0.14F);
    const float x = p_s.x() + 0.37F * board;
    const float wave = 0.012F * std::sin(9.0F * x) + 0.004F * std::sin(31.0F * x + board);
    const float ring = std::sin((p_s.y() + wave) * 420.0F + 3.0F * std::sin(4.0F * x + 1.7F * board));
    const float seam = std::abs(p_s.y() / 0.14F - board - 0.5F) > 0.49F ? 0.7F : 1.0F;
    const float tone = seam * (0.9F + 0.07F * ring + 0.05F * std::sin(2.4F * board));
    return tone * Vec3(0.66F, 0.45F, 0.27F);
}

/// Share of the lamp's light that reaches a point: the lamp hangs over the left rear.
float lamp_share(const Scene& scene, const Vec3& p_s, const Vec3& normal_s) {
    const Vec3 to_lamp = Vec3(-0.45F, 0.35F, 1.0F).normalized();
    float share = 1.0F;
    for (float t = 0.006F; t < 0.3F && share > 0.0F;) {
        const float free = scene.distance(p_s + 0.002F * normal_s + t * to_lamp);
        share = std::min(share, 12.0F * free / t);
        t += std::max(free, 0.004F);
    }
    return std::max(share, 0.0F);
}

}  // namespace

std::optional<Vec3> first_hit(const Scene& scene, const Vec3& from_s, const Vec3& direction_s) {
    constexpr float farthest_m = 10.0F;
    const float distance_m = march(scene, from_s, direction_s, 0.0F, 0.0F);
    if (distance_m > farthest_m) return std::nullopt;
    return Vec3(from_s + distance_m * direction_s);
}

std::vector<float> render_static_depth(const Scene& scene, const TableView& view) {
    const int width = view.intrinsics.width_px;
    const int height = view.intrinsics.height_px;
    std::vector<float> depth_m(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto trace_tile = [&](int left, int top) {
        const float start = tile_start_m(scene, view, left, top);
        for (int v = top; v < std::min(top + tile_px, height); ++v)
            for (int u = left; u < std::min(left + tile_px, width); ++u) {
                const Vec3 ray = view.ray_c(static_cast<float>(u), static_cast<float>(v));
                const float length = ray.norm();
                const Vec3 direction_s = view.rotation_s_c * (ray / length);
                depth_m[static_cast<std::size_t>(v * width + u)] =
                    march(scene, view.camera_s, direction_s, start, 0.0F) / length;
            }
    };
    for (int top = 0; top < height; top += tile_px)
        for (int left = 0; left < width; left += tile_px) trace_tile(left, top);
    return depth_m;
}

Vec3 shade(const Vec3& albedo, const Vec3& normal_s) {
    const Vec3 to_lamp = Vec3(-0.45F, 0.35F, 1.0F).normalized();
    return albedo * (0.42F + 0.2F * normal_s.z() + 0.5F * std::max(0.0F, normal_s.dot(to_lamp)));
}

std::uint8_t to_byte(float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

std::vector<std::uint8_t> render_static_color(const Scene& scene, const TableView& view,
                                              const std::vector<float>& depth_m) {
    const int width = view.intrinsics.width_px;
    std::vector<std::uint8_t> color_rgb;
    color_rgb.reserve(3 * depth_m.size());
    for (std::size_t i = 0; i < depth_m.size(); ++i) {
        const int u = static_cast<int>(i) % width;
        const int v = static_cast<int>(i) / width;
        const Vec3 p_s = view.to_scene(view.ray_c(static_cast<float>(u), static_cast<float>(v)) * depth_m[i]);
        const Vec3 normal_s = scene.normal(p_s);
        const int shape = scene.nearest(p_s);
        const Vec3 albedo = shape < 0 ? wood(p_s) : scene.shapes()[static_cast<std::size_t>(shape)].albedo;
        const Vec3 light = shade(albedo, normal_s) * (0.6F + 0.4F * lamp_share(scene, p_s, normal_s));
        for (int c = 0; c < 3; ++c) color_rgb.push_back(to_byte(light[c]));
    }
    return color_rgb;
}

}  // namespace touchstone::sim
