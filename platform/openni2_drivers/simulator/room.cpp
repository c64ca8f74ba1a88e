#include "platform/openni2_drivers/simulator/room.hpp"

#include <algorithm>
#include <utility>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {
namespace {

constexpr float half_room_m = 1.5F;
constexpr float room_height_m = 2.4F;

/// Builds the room thing by thing. No two random numbers are drawn within one call's arguments: their order
/// would be the compiler's.
class Furniture {
  public:
    explicit Furniture(std::uint64_t seed) : random_(seed, 0x4003), paint_(seed, 0xc0104) {}

    void add_shell() {
        const float side = 2.0F * half_room_m;
        add_quad(mesh, {-half_room_m, -half_room_m, 0.0F}, {side, 0.0F, 0.0F}, {0.0F, side, 0.0F},
                 {0.52F, 0.40F, 0.28F});
        add_quad(mesh, {-half_room_m, half_room_m, 0.0F}, {side, 0.0F, 0.0F}, {0.0F, 0.0F, room_height_m},
                 {0.72F, 0.74F, 0.66F});
        add_quad(mesh, {-half_room_m, -half_room_m, 0.0F}, {0.0F, side, 0.0F}, {0.0F, 0.0F, room_height_m},
                 {0.62F, 0.68F, 0.74F});
    }

    void add_table() {
        const float top_m = between(0.68F, 0.76F);
        const Vec3 half = size({0.45F, 0.28F, 0.015F}, {0.55F, 0.34F, 0.015F});
        const Placement top = near({-0.35F, 1.05F, top_m - half.z()}, 0.06F, 0.0F, 0.12F);
        const Vec3 wood(0.62F, 0.43F, 0.24F);
        add_box(mesh, top, half, wood);
        add_legs(top, half - Vec3(0.04F, 0.04F, 0.0F), top_m - 2.0F * half.z(), 0.02F, wood);
        add_things(top, half, top_m, 5);
    }

    void add_chair() {
        const float seat_m = between(0.42F, 0.48F);
        const float leg_m = between(0.010F, 0.015F);
        const Vec3 half(0.20F, 0.20F, 0.0125F);
        const Placement seat = near({-0.30F, 0.42F, seat_m - half.z()}, 0.08F, 0.0F, 0.5F);
        const Vec3 paint = color();
        add_box(mesh, seat, half, paint);
        add_legs(seat, half - Vec3(0.015F, 0.015F, 0.0F), seat_m - 2.0F * half.z(), leg_m, paint);
        // Two posts and three slats on the side away from the table.
        for (const float x : {-0.185F, 0.185F})
            add_box(mesh, beside(seat, {x, -0.185F, 0.23F}), {0.0125F, 0.0125F, 0.22F}, paint);
        for (const float z : {0.20F, 0.30F, 0.40F})
            add_box(mesh, beside(seat, {0.0F, -0.185F, z}), {0.18F, 0.008F, 0.02F}, paint);
    }

    void add_shelf() {
        for (const float height_m : {1.05F, 1.50F}) {
            const Vec3 half = size({0.125F, 0.38F, 0.01F}, {0.125F, 0.48F, 0.01F});
            Placement board = near({0.0F, -0.05F, height_m}, 0.06F, 0.0F, 0.0F);
            board.center.x() = half.x() - half_room_m;
            add_box(mesh, board, half, {0.70F, 0.62F, 0.50F});
            add_things(board, half, board.center.z() + half.z(), 4);
        }
    }

    /// Boxes, balls, a bin and an upright board.
    void add_floor_things() {
        const Vec3 chest = size({0.15F, 0.18F, 0.15F}, {0.22F, 0.28F, 0.25F});
        add_on_floor(chest, {-1.15F, -0.30F, 0.0F}, 0.05F, 0.3F);
        const Vec3 crate = size({0.11F, 0.09F, 0.08F}, {0.14F, 0.12F, 0.14F});
        add_on_floor(crate, {-0.72F, -0.62F, 0.0F}, 0.06F, 0.8F);
        add_on_floor({0.22F, 0.005F, 0.35F}, {0.48F, 1.15F, 0.0F}, 0.05F, 1.2F);
        for (const Vec3& foot : {Vec3(-0.85F, 0.15F, 0.0F), Vec3(0.45F, 0.65F, 0.0F)}) {
            const float radius_m = between(0.07F, 0.13F);
            const Placement ball = near(foot, 0.05F, 0.0F, 0.0F);
            add_ball(mesh, {ball.center.x(), ball.center.y(), radius_m}, radius_m, color());
        }
        const Vec3 bin = size({0.10F, 0.0F, 0.15F}, {0.14F, 0.0F, 0.22F});
        Placement place = near({0.95F, 1.20F, 0.0F}, 0.05F, 0.0F, 0.0F);
        place.center.z() = bin.z();
        add_cylinder(mesh, place, bin.x(), bin.z(), color());
    }

    /// A picture and a cupboard on one wall, a picture on the other.
    void add_wall_things() {
        const Vec3 picture = size({0.15F, 0.015F, 0.12F}, {0.25F, 0.015F, 0.20F});
        add_on_wall(picture, {-0.75F, half_room_m - picture.y(), 1.50F}, Vec3::UnitX());
        const Vec3 cupboard = size({0.20F, 0.10F, 0.15F}, {0.30F, 0.10F, 0.22F});
        add_on_wall(cupboard, {0.25F, half_room_m - cupboard.y(), 1.60F}, Vec3::UnitX());
        const Vec3 frame = size({0.02F, 0.20F, 0.15F}, {0.02F, 0.30F, 0.25F});
        add_on_wall(frame, {frame.x() - half_room_m, 0.95F, 1.35F}, Vec3::UnitY());
    }

    TriangleMesh mesh;

  private:
    float between(float least, float most) { return random_.uniform(least, most); }
    float jitter(float most) { return random_.uniform(-most, most); }

    Vec3 size(const Vec3& least, const Vec3& most) {
        Vec3 half;
        for (int i = 0; i < 3; ++i) half[i] = between(least[i], most[i]);
        return half;
    }

    Vec3 color() {
        Vec3 rgb;
        for (int i = 0; i < 3; ++i) rgb[i] = paint_.uniform(0.15F, 0.85F);
        return rgb;
    }

    Placement near(Vec3 center, float spread_m, float yaw_rad, float yaw_spread_rad) {
        center.x() += jitter(spread_m);
        center.y() += jitter(spread_m);
        return upright(center, yaw_rad + jitter(yaw_spread_rad));
    }

    void add_on_floor(const Vec3& half, const Vec3& foot, float spread_m, float yaw_spread_rad) {
        add_box(mesh, near({foot.x(), foot.y(), half.z()}, spread_m, 0.0F, yaw_spread_rad), half, color());
    }

    void add_on_wall(const Vec3& half, Vec3 center, const Vec3& along) {
        center += jitter(0.12F) * along;
        center.z() += jitter(0.08F);
        add_box(mesh, upright(center, 0.0F), half, color());
    }

    static Placement beside(const Placement& placement, const Vec3& offset) {
        return {placement.center + placement.axes * offset, placement.axes};
    }

    void add_legs(const Placement& top, const Vec3& reach, float length_m, float half_m, const Vec3& albedo) {
        for (const float x : {-1.0F, 1.0F})
            for (const float y : {-1.0F, 1.0F})
                add_box(mesh, beside(top, {x * reach.x(), y * reach.y(), 0.5F * length_m - top.center.z()}),
                        {half_m, half_m, 0.5F * length_m}, albedo);
    }

    /// A row of boxes, balls and cylinders on a board, along its longer side.
    void add_things(const Placement& board, const Vec3& half, float top_m, int count) {
        const bool along_x = half.x() > half.y();
        const float room_m = 2.0F * std::max(half.x(), half.y()) / static_cast<float>(count);
        const float most_m = std::min(0.4F * room_m, 0.75F * std::min(half.x(), half.y()));
        const int first = random_.below(3);
        for (int i = 0; i < count; ++i) {
            const float along = (static_cast<float>(i) + 0.5F) * room_m - std::max(half.x(), half.y());
            const float aside = jitter(0.2F * std::min(half.x(), half.y()));
            Vec3 foot =
                board.center + board.axes * (along_x ? Vec3(along, aside, 0.0F) : Vec3(aside, along, 0.0F));
            foot.z() = top_m;
            add_thing(foot, most_m, (first + i) % 3);
        }
    }

    void add_thing(Vec3 foot, float most_m, int kind) {
        const float size_m = between(0.6F, 1.0F) * most_m;
        const float half_height_m = between(0.5F, 1.5F) * size_m;
        const float yaw = jitter(1.5F);
        foot.z() += kind == 1 ? size_m : half_height_m;
        if (kind == 0)
            add_box(mesh, upright(foot, yaw), {0.7F * size_m, 0.6F * size_m, half_height_m}, color());
        if (kind == 1) add_ball(mesh, foot, size_m, color());
        if (kind == 2) add_cylinder(mesh, upright(foot, yaw), 0.8F * size_m, half_height_m, color());
    }

    Random random_;
    Random paint_;
};

}  // namespace

TriangleMesh make_room(std::uint64_t seed) {
    Furniture furniture(seed);
    furniture.add_shell();
    furniture.add_table();
    furniture.add_chair();
    furniture.add_shelf();
    furniture.add_floor_things();
    furniture.add_wall_things();
    return std::move(furniture.mesh);
}

TriangleMesh make_wall() {
    TriangleMesh mesh;
    add_quad(mesh, {-6.0F, 0.0F, -4.0F}, {12.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 8.0F}, {0.72F, 0.74F, 0.66F});
    return mesh;
}

Eigen::Isometry3d look_at(const Eigen::Vector3d& eye_s, const Eigen::Vector3d& target_s) {
    const Eigen::Vector3d forward = (target_s - eye_s).normalized();
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    Eigen::Isometry3d T_s_c = Eigen::Isometry3d::Identity();
    T_s_c.linear() << right, forward.cross(right), forward;
    T_s_c.translation() = eye_s;
    return T_s_c;
}

Viewpoint room_viewpoint() { return {look_at({0.75, -0.75, 1.35}, {-0.45, 0.45, 0.65}), 1.8}; }

Viewpoint wall_viewpoint() { return {look_at({0.0, -1.2, 0.0}, {0.0, 0.0, 0.0}), 1.2}; }

}  // namespace touchstone::sim
