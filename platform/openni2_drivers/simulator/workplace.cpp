#include "platform/openni2_drivers/simulator/workplace.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone::sim {
namespace {

bool is_part_clear(const HandPart& part, const Workplace& place) {
    constexpr float spacing_m = 0.01F;
    const int steps = std::max(4, static_cast<int>((part.cone.b - part.cone.a).norm() / spacing_m));
    constexpr float margin_m = 0.004F;  // of the halves
    for (int i = 0; i <= steps; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(steps);
        const Vec3 middle = part.cone.a + share * (part.cone.b - part.cone.a);
        const float radius = part.cone.radius_a + share * (part.cone.radius_b - part.cone.radius_a);
        if (place.half * middle.x() < 0.0F ||
            (place.half != 0.0F && std::abs(middle.x()) < radius + margin_m))
            return false;
        float needed = part.clearance_m;
        if (part.touches && i == 0) needed = -2e-5F;
        if (part.touches && i == 1) needed = 0.0F;
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
        return ConeTracer({cone.a - view.camera_s, cone.b - view.camera_s, cone.radius_a, cone.radius_b})(
            direction_s);
    };
    const float seen = seen_from_camera(hand.parts[part].cone);
    // A finger that points along the ray hides its own tip.
    if (seen < (tip_s - view.camera_s).norm() - 2.5F * hand.parts[part].cone.radius_a) return false;
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
