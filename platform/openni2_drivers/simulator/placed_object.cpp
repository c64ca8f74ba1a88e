#include "platform/openni2_drivers/simulator/placed_object.hpp"

#include <algorithm>
#include <cmath>

#include "platform/openni2_drivers/simulator/pixel_box.hpp"
#include "platform/openni2_drivers/simulator/random.hpp"
#include "platform/openni2_drivers/simulator/static_layer.hpp"

namespace touchstone::sim {
namespace {

Shape make_object(ObjectKind kind, Random& random) {
    Shape shape;
    shape.albedo = {0.75F, 0.3F, 0.25F};
    if (kind == ObjectKind::ball) {
        shape.kind = Shape::Kind::ball;
        shape.radius_m = random.uniform(0.035F, 0.06F);
        shape.center.z() = shape.radius_m;
        return shape;
    }
    if (kind == ObjectKind::can) {
        shape.kind = Shape::Kind::can;
        shape.half = {random.uniform(0.03F, 0.05F), 0.0F, random.uniform(0.035F, 0.06F)};
        shape.radius_m = 0.004F;
    } else {
        shape.half = kind == ObjectKind::book
                         ? Vec3(0.075F, 0.105F, random.uniform(0.012F, 0.02F))
                         : Vec3(random.uniform(0.035F, 0.07F), random.uniform(0.035F, 0.07F),
                                random.uniform(0.02F, 0.05F));
        shape.radius_m = 0.002F;
        const float yaw = random.uniform(-1.5F, 1.5F);
        shape.along = {std::cos(yaw), std::sin(yaw)};
    }
    shape.center.z() = shape.half.z();
    return shape;
}

float reach_of(const Shape& shape) {
    return shape.kind == Shape::Kind::box ? shape.half.head<2>().norm()
                                          : std::max(shape.half.x(), shape.radius_m);
}

/// Where the shape stands free of everything else on the table; the middle where there is no such place.
Vec3 free_place(const Shape& shape, const Scene& scene, Random& random) {
    const float reach = reach_of(shape) + 0.03F;
    for (int attempt = 0; attempt < 200; ++attempt) {
        const Vec3 place(random.uniform(-0.2F, 0.2F), random.uniform(-0.12F, 0.12F), shape.center.z());
        bool is_free = true;
        for (int turn = 0; turn < 16 && is_free; ++turn) {
            const float angle = radians(22.5F * static_cast<float>(turn));
            for (const float share : {0.0F, 0.5F, 1.0F}) {
                const Vec3 p(place.x() + share * reach * std::cos(angle),
                             place.y() + share * reach * std::sin(angle), 0.005F);
                is_free = is_free && scene.distance(p) > 0.0049F;
            }
        }
        if (is_free) return place;
    }
    return {0.0F, 0.0F, shape.center.z()};
}

float top_of(const Shape& shape) {
    return shape.center.z() + (shape.kind == Shape::Kind::ball ? shape.radius_m : shape.half.z());
}

}  // namespace

PlacedObject::PlacedObject(const SimulatorConfig& config, const Scene& scene, const TableView& view)
    : put_s_(config.put_s), take_s_(config.take_s), cycle_s_(config.cycle_s) {
    Random random(config.seed, 0x0b1ec);
    resting_ = make_object(config.object, random);
    resting_.center = free_place(resting_, scene, random);
    const float side = random.chance(0.5F) ? 1.0F : -1.0F;
    hand_shape_ = make_hand_shape(random, side);
    const Vec3 edge_s = view.on_table(319.5F + side * 120.0F, 479.0F);
    shoulder_s_ = edge_s + Vec3(0.0F, -0.12F, std::min(0.4F, 0.5F * view.camera_s.z()));
    outside_.index_tip = edge_s + Vec3(0.0F, -0.45F, 0.2F);
    over_ = outside_;
    over_.index_tip = {resting_.center.x(), resting_.center.y(),
                       top_of(resting_) + hand_shape_.fingertip_radius_m + 0.001F};
    const Vec3 way = over_.index_tip - outside_.index_tip;
    outside_.yaw_rad = over_.yaw_rad = std::atan2(way.y(), way.x());
}

/// share: 0 outside, 1 at the object.
HandPosture PlacedObject::posture(double share) const {
    const float s = minimum_jerk(static_cast<float>(std::clamp(share, 0.0, 1.0)));
    HandPosture now = over_;
    now.index_tip = outside_.index_tip + s * (over_.index_tip - outside_.index_tip);
    // From above at the end, so that what is carried does not cut through what lies on the way.
    now.index_tip.z() += 0.6F * (1.0F - s) * s;
    now.thumb_tip = relaxed_thumb_tip(hand_shape_, now);
    return now;
}

PlacedObject::Moment PlacedObject::at(double time_s) const {
    const double time = cycle_s_ > 0.0 ? std::fmod(time_s, cycle_s_) : time_s;
    Moment moment;
    const bool put_visit = put_s_ >= 0.0 && time > put_s_ - visit_s && time < put_s_ + hold_s + visit_s;
    const bool take_visit = take_s_ >= 0.0 && time > take_s_ - visit_s && time < take_s_ + hold_s + visit_s;
    const bool stands = time >= put_s_ && (take_s_ < 0.0 || time < take_s_ + hold_s);
    if (stands) moment.object = resting_;
    if (!put_visit && !take_visit) return moment;
    const double met_s = put_visit ? put_s_ : take_s_;
    const double share =
        time < met_s ? (time - met_s + visit_s) / visit_s : 1.0 - (time - met_s - hold_s) / visit_s;
    const HandPosture now = posture(share);
    moment.hand = build_hand(hand_shape_, now, shoulder_s_, false);
    const bool carried = put_visit ? time < put_s_ : time >= take_s_ + hold_s;
    if (carried) {
        moment.object = resting_;
        moment.object->center += now.index_tip - over_.index_tip;
    }
    return moment;
}

void draw_shape(Picture& picture, const Shape& shape, const TableView& view) {
    const float radius = shape.kind == Shape::Kind::ball ? shape.radius_m : shape.half.norm();
    const Vec3 center_c = view.to_camera(shape.center);
    const PixelBounds box = bounds_of_ball(center_c, radius, view.intrinsics);
    const int width = view.intrinsics.width_px;
    for (int v = box.top; v < box.bottom; ++v) {
        for (int u = box.left; u < box.right; ++u) {
            const Vec3 ray_c = view.ray_c(static_cast<float>(u), static_cast<float>(v));
            const Vec3 direction_s = view.rotation_s_c * ray_c;
            const float length = ray_c.norm();
            // Marched from the ball around it; missed when the ray leaves that ball.
            float z = std::max(0.05F, (center_c.norm() - radius) / length - 0.01F);
            const float end = (center_c.norm() + radius) / length + 0.01F;
            float gap = 1.0F;
            for (int i = 0; i < 128 && gap > 3e-6F && z < end; ++i) {
                gap = shape.distance(view.camera_s + z * direction_s);
                z += std::max(gap, 0.0F) / length;
            }
            const auto at = static_cast<std::size_t>(v * width + u);
            if (gap > 3e-6F || z >= picture.depth_m[at]) continue;
            picture.depth_m[at] = z;
        }
    }
}

void color_shape(std::vector<std::uint8_t>& color_rgb, const Picture& picture, const Shape& shape,
                 const TableView& view) {
    const float radius = shape.kind == Shape::Kind::ball ? shape.radius_m : shape.half.norm();
    const PixelBounds box = bounds_of_ball(view.to_camera(shape.center), radius, view.intrinsics);
    const Scene alone({shape});
    for (int v = box.top; v < box.bottom; ++v) {
        for (int u = box.left; u < box.right; ++u) {
            const auto at = static_cast<std::size_t>(v * view.intrinsics.width_px + u);
            if (picture.part[at] != 0) continue;
            const Vec3 ray_c = view.ray_c(static_cast<float>(u), static_cast<float>(v));
            const Vec3 p_s = view.to_scene(ray_c * picture.depth_m[at]);
            if (!(shape.distance(p_s) < 5e-5F)) continue;
            const Vec3 light = shade(shape.albedo, alone.normal(p_s));
            for (int c = 0; c < 3; ++c) color_rgb[3 * at + static_cast<std::size_t>(c)] = to_byte(light[c]);
        }
    }
}

}  // namespace touchstone::sim
