#pragma once

#include <random>
#include <vector>

#include "pipeline/foreground_segmentation.hpp"
#include "tests/support/oriented_scene.hpp"

namespace touchstone::test {

/// A rigid thing of balls that constrains all six directions, 0.25 m wide, around the origin.
inline OrientedSurface thing_of_balls() {
    return nearest_of({ball({0.0, 0.0, 0.0}, 0.06), ball({0.09, 0.02, -0.02}, 0.04),
                       ball({-0.08, 0.03, 0.01}, 0.05), ball({0.01, -0.08, -0.01}, 0.035),
                       ball({0.03, 0.09, 0.02}, 0.045)});
}

/// Things that move before nothing: what a segmentation would give. T_o_c: camera to each thing's own frame.
struct MovingThings {
    MovingThings(const Device& device, const Intrinsics& intrinsics)
        : k(intrinsics), live(device, make_map_shape(k)), foreground(device, make_map_shape(k)) {}

    /// The nearest thing at each pixel, with Gaussian noise of depth; normals stay exact.
    void show(const std::vector<RigidTransform>& T_o_c, float noise_m = 0.0f) {
        reference::OrientedPicture picture{k.width_px, k.height_px, {}, {}};
        picture.depth_m.assign(static_cast<std::size_t>(k.width_px * k.height_px), 0.0f);
        picture.normals.assign(picture.depth_m.size(), Eigen::Vector3f::Zero());
        std::vector<int> labels(picture.depth_m.size(), -1);
        for (std::size_t thing = 0; thing < T_o_c.size(); ++thing) {
            const reference::OrientedPicture seen = view_of(k, thing_of_balls(), T_o_c[thing]);
            for (std::size_t i = 0; i < labels.size(); ++i) {
                if (seen.depth_m[i] <= 0.0f) continue;
                picture.depth_m[i] = seen.depth_m[i];
                picture.normals[i] = seen.normals[i];
                labels[i] = static_cast<int>(thing);
            }
        }
        exact_m = picture.depth_m;
        std::normal_distribution<float> normal(0.0f, 1.0f);
        for (float& z : picture.depth_m)
            if (z > 0.0f) z += noise_m * normal(random);
        write_live(picture, live);
        label(labels, static_cast<int>(T_o_c.size()));
    }

    Intrinsics k;
    LiveMaps live;
    Foreground foreground;
    std::vector<float> exact_m;

  private:
    void label(const std::vector<int>& labels, int count) {
        const MapShape& shape = live.shape;
        std::vector<int> padded_labels(map_pixels(shape), -1);
        std::vector<std::uint8_t> mask(map_pixels(shape), 0);
        foreground.components.assign(static_cast<std::size_t>(count), {});
        for (int i = 0; i < count; ++i)
            foreground.components[static_cast<std::size_t>(i)] = {
                i, 0, {k.width_px, k.height_px, -1, -1}, 1.0f};
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) {
                const int of_pixel = labels[static_cast<std::size_t>(y * k.width_px + x)];
                if (of_pixel < 0) continue;
                padded_labels[map_index(shape, x, y)] = of_pixel;
                mask[map_index(shape, x, y)] = 255;
                ForegroundComponent& component = foreground.components[static_cast<std::size_t>(of_pixel)];
                ++component.pixels;
                PixelBox& box = component.box;
                box = {std::min(box.min_x_px, x), std::min(box.min_y_px, y), std::max(box.max_x_px, x),
                       std::max(box.max_y_px, y)};
            }
        }
        foreground.labels.write(padded_labels);
        foreground.mask.write(mask);
    }

    std::mt19937 random{7};
};

}  // namespace touchstone::test
