#include "platform/openni2_drivers/simulator/hand_layer.hpp"

#include <algorithm>
#include <cmath>

#include "platform/openni2_drivers/simulator/static_layer.hpp"

namespace touchstone::sim {
namespace {

/// Where a part may show: the hull of two discs, pixels.
struct Footprint {
    Eigen::Vector2f from, to;
    float reach_px = 0.0F;
    bool everywhere = false;  ///< too near to the camera for a bound
    bool nowhere = false;     ///< behind the camera
};

struct Span {
    int begin = 0, end = 0;
};

Footprint footprint(const RoundCone& cone_c, const TableView& view) {
    constexpr float near_m = 0.1F;
    Footprint print;
    const float radius = std::max(cone_c.radius_a, cone_c.radius_b);
    const float nearest = std::min(cone_c.a.z(), cone_c.b.z()) - radius;
    const float farthest = std::max(cone_c.a.z(), cone_c.b.z()) + radius;
    print.nowhere = farthest < near_m;
    print.everywhere = !print.nowhere && nearest < near_m;
    if (print.nowhere || print.everywhere) return print;
    print.from = view.project(cone_c.a);
    print.to = view.project(cone_c.b);
    // A ball off the axis projects to an ellipse that is longer by the length of its ray at z = 1.
    const float stretch = std::max(cone_c.a.norm() / cone_c.a.z(), cone_c.b.norm() / cone_c.b.z());
    print.reach_px = 1.05F * stretch * view.intrinsics.fx_px * radius / nearest + 1.0F;
    return print;
}

Span clipped(float least, float most, int size) {
    const float top = static_cast<float>(size);
    return {static_cast<int>(std::clamp(std::floor(least), 0.0F, top)),
            static_cast<int>(std::clamp(std::floor(most) + 1.0F, 0.0F, top))};
}

Span rows(const Footprint& print, int height_px) {
    if (print.everywhere) return {0, height_px};
    return clipped(std::min(print.from.y(), print.to.y()) - print.reach_px,
                   std::max(print.from.y(), print.to.y()) + print.reach_px, height_px);
}

Span columns(const Footprint& print, int row, int width_px) {
    if (print.everywhere) return {0, width_px};
    float least = std::min(print.from.x(), print.to.x()) - print.reach_px;
    float most = std::max(print.from.x(), print.to.x()) + print.reach_px;
    const Eigen::Vector2f along = print.to - print.from;
    // The strip around the line through both ends.
    if (std::abs(along.y()) > 1.0F) {
        const float middle =
            print.from.x() + (static_cast<float>(row) - print.from.y()) * along.x() / along.y();
        const float half = print.reach_px * along.norm() / std::abs(along.y());
        least = std::max(least, middle - half);
        most = std::min(most, middle + half);
    }
    return clipped(least, most, width_px);
}

RoundCone in_camera(const RoundCone& cone_s, const TableView& view) {
    return {view.to_camera(cone_s.a), view.to_camera(cone_s.b), cone_s.radius_a, cone_s.radius_b};
}

}  // namespace

void clear_picture(Picture& picture, const std::vector<float>& static_depth_m) {
    picture.depth_m = static_depth_m;
    picture.part.assign(static_depth_m.size(), 0);
    picture.owner.resize(static_depth_m.size());
}

void draw_hand(Picture& picture, const Hand& hand, int owner, const TableView& view) {
    const int width = view.intrinsics.width_px;
    for (std::size_t number = 0; number < hand.parts.size(); ++number) {
        const RoundCone cone = in_camera(hand.parts[number].cone, view);
        const Footprint print = footprint(cone, view);
        if (print.nowhere) continue;
        const ConeTracer trace(cone);
        const Span high = rows(print, view.intrinsics.height_px);
        for (int v = high.begin; v < high.end; ++v) {
            const Span wide = columns(print, v, width);
            for (int u = wide.begin; u < wide.end; ++u) {
                const float z = trace(view.ray_c(static_cast<float>(u), static_cast<float>(v)));
                const auto i = static_cast<std::size_t>(v * width + u);
                if (z <= 0.0F || z >= picture.depth_m[i]) continue;
                picture.depth_m[i] = z;
                picture.part[i] = static_cast<std::uint8_t>(1 + number);
                picture.owner[i] = static_cast<std::uint8_t>(owner);
            }
        }
    }
}

void color_hand(std::vector<std::uint8_t>& color_rgb, const Picture& picture, const Hand& hand,
                const HandShape& shape, int owner, const TableView& view) {
    const int width = view.intrinsics.width_px;
    for (std::size_t i = 0; i < picture.part.size(); ++i) {
        if (picture.part[i] == 0 || picture.owner[i] != owner) continue;
        const HandPart& part = hand.parts[static_cast<std::size_t>(picture.part[i] - 1)];
        const auto u = static_cast<float>(static_cast<int>(i) % width);
        const auto v = static_cast<float>(static_cast<int>(i) / width);
        const Vec3 p_s = view.to_scene(view.ray_c(u, v) * picture.depth_m[i]);
        const Vec3 albedo = part.material == HandMaterial::skin ? shape.skin : shape.sleeve;
        const Vec3 light = shade(albedo, normal_at(part.cone, p_s));
        for (int c = 0; c < 3; ++c) color_rgb[3 * i + static_cast<std::size_t>(c)] = to_byte(light[c]);
    }
}

}  // namespace touchstone::sim
