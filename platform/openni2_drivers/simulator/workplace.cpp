#include "platform/openni2_drivers/simulator/workplace.hpp"

#include <cmath>

namespace touchstone::sim {
namespace {

bool is_part_clear(const HandPart& part, const Workplace& place) {
    constexpr int steps = 4;
    constexpr float margin_m = 0.004F;  // of the halves
    for (int i = 0; i <= steps; ++i) {
        const float share = static_cast<float>(i) / steps;
        const Vec3 middle = part.cone.a + share * (part.cone.b - part.cone.a);
        const float radius = part.cone.radius_a + share * (part.cone.radius_b - part.cone.radius_a);
        if (place.half * middle.x() < 0.0F ||
            (place.half != 0.0F && std::abs(middle.x()) < radius + margin_m))
            return false;
        const float needed = !part.touches ? part.clearance_m
                             : i == 0      ? -2e-5F
                             : i == 1      ? 0.0F
                                           : part.clearance_m;
        if (gap_m(place.scene, middle, radius) < needed) return false;
    }
    return true;
}

}  // namespace

bool is_clear(const Hand& hand, const Workplace& place) {
    for (const HandPart& part : hand.parts)
        if (!is_part_clear(part, place)) return false;
    return true;
}

bool is_tip_visible(const Hand& hand, std::size_t part, const Workplace& place) {
    const TableView& view = place.view;
    const Vec3 tip_s = hand.parts[part].cone.a;
    const Vec3 direction_s = (tip_s - view.camera_s).normalized();
    const auto seen_from_camera = [&](const RoundCone& cone) {
        return intersect({cone.a - view.camera_s, cone.b - view.camera_s, cone.radius_a, cone.radius_b},
                         direction_s);
    };
    const float seen = seen_from_camera(hand.parts[part].cone);
    for (std::size_t i = 0; i < hand.parts.size(); ++i) {
        const float t = seen_from_camera(hand.parts[i].cone);
        if (i != part && t > 0.0F && t < seen) return false;
    }
    const Vec3 tip_c = view.to_camera(tip_s);
    const Eigen::Vector2f pixel = view.project(tip_c);
    const int u = static_cast<int>(std::lround(pixel.x()));
    const int v = static_cast<int>(std::lround(pixel.y()));
    if (u < 8 || v < 8 || u >= view.intrinsics.width_px - 16 || v >= view.intrinsics.height_px - 8)
        return false;
    return place.depth_m[static_cast<std::size_t>(v * view.intrinsics.width_px + u)] > tip_c.z();
}

}  // namespace touchstone::sim
