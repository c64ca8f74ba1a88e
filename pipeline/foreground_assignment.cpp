#include "pipeline/foreground_assignment.hpp"

#include <algorithm>

namespace touchstone {

namespace {

struct Pairing {
    int volume = 0, component = 0;
    float covered = 0.0f;  ///< share of the component that the prediction covers
    float distance_m = 0.0f;
};

float covered_share(const MovingVolume& volume, const ComponentPoints& component) {
    if (component.map_index.empty()) return 0.0f;
    const auto depth_m = volume.prediction.depth_m.map_read();
    const auto covered =
        std::ranges::count_if(component.map_index, [&](std::size_t pixel) { return depth_m[pixel] > 0.0f; });
    return static_cast<float>(covered) / static_cast<float>(component.map_index.size());
}

bool better(const Pairing& a, const Pairing& b) {
    return a.covered != b.covered ? a.covered > b.covered : a.distance_m < b.distance_m;
}

}  // namespace

ComponentPoints sample_component(const Foreground& foreground, const Buffer<float>& depth_m,
                                 const ForegroundComponent& component, const Intrinsics& k, int step_px) {
    ComponentPoints points;
    const PixelBox& box = component.box;
    points.region = {box.min_x_px, box.min_y_px, box.max_x_px + 1, box.max_y_px + 1};
    const auto labels = foreground.labels.map_read();
    const auto depths = depth_m.map_read();
    for (int y = box.min_y_px; y <= box.max_y_px; y += step_px) {
        for (int x = box.min_x_px; x <= box.max_x_px; x += step_px) {
            const std::size_t pixel = map_index(foreground.shape, x, y);
            const float z = depths[pixel];
            if (labels[pixel] != component.label || z <= 0.0f) continue;
            points.at_c_m.push_back(back_project(k, x, y, z));
            points.map_index.push_back(pixel);
            points.centre_c_m += points.at_c_m.back();
        }
    }
    if (!points.at_c_m.empty()) points.centre_c_m /= static_cast<float>(points.at_c_m.size());
    return points;
}

std::vector<int> assign_components(std::span<const MovingVolume> volumes,
                                   std::span<const ComponentPoints> components, float reach_m) {
    std::vector<Pairing> pairings;
    for (std::size_t v = 0; v < volumes.size(); ++v) {
        for (std::size_t c = 0; c < components.size(); ++c) {
            const float share = covered_share(volumes[v], components[c]);
            const float distance_m = (volumes[v].last_centre_c_m - components[c].centre_c_m).norm();
            if (share <= 0.0f && distance_m > reach_m) continue;
            pairings.push_back({static_cast<int>(v), static_cast<int>(c), share, distance_m});
        }
    }
    std::ranges::sort(pairings, better);
    std::vector<int> component_of(volumes.size(), -1);
    std::vector<bool> taken(components.size(), false);
    for (const Pairing& pairing : pairings) {
        int& of_volume = component_of[static_cast<std::size_t>(pairing.volume)];
        const auto component = static_cast<std::size_t>(pairing.component);
        if (of_volume >= 0 || taken[component]) continue;
        of_volume = pairing.component;
        taken[component] = true;
    }
    return component_of;
}

}  // namespace touchstone
