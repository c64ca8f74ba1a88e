#include "platform/openni2_drivers/simulator/person.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchstone::sim {
namespace {

using Eigen::Vector3d;

constexpr double tau = 2.0 * std::numbers::pi;
constexpr double step_frames = 34.0;  ///< of a left and a right step

/// From outside to where they walk, in so many frames: up to 50 mm each.
constexpr double entry_frames = 75.0;
constexpr double entry_m = 2.0;

/// A joint in the body's frame: x to its left, y ahead, z up, metres.
struct Body {
    Placement at;
    Vec3 operator()(float left, float ahead, float up) const {
        return at.center + at.axes * Vec3(left, ahead, up);
    }
};

void add(Hand& hand, const Vec3& a, float radius_a, const Vec3& b, float radius_b, HandMaterial material) {
    hand.parts.push_back({{a, b, radius_a, radius_b}, material, 0.0F, false});
}

void add_trunk(Hand& hand, const Body& body) {
    using enum HandMaterial;
    for (const float side : {-1.0F, 1.0F}) {
        add(hand, body(0.12F * side, 0.0F, 1.38F), 0.085F, body(0.09F * side, 0.01F, 1.00F), 0.095F, sleeve);
        add(hand, body(0.0F, 0.0F, 1.42F), 0.06F, body(0.17F * side, 0.0F, 1.42F), 0.055F, sleeve);
    }
    add(hand, body(0.0F, 0.02F, 1.36F), 0.11F, body(0.0F, 0.02F, 1.02F), 0.11F, sleeve);
    add(hand, body(0.0F, 0.0F, 1.42F), 0.055F, body(0.0F, 0.02F, 1.54F), 0.055F, skin);
    add(hand, body(0.0F, 0.02F, 1.58F), 0.075F, body(0.0F, 0.03F, 1.67F), 0.085F, skin);
}

/// `swing`: -1 back to 1 ahead.
void add_leg(Hand& hand, const Body& body, float side, float swing) {
    using enum HandMaterial;
    const Vec3 hip = body(0.09F * side, 0.0F, 0.93F);
    const Vec3 knee = body(0.10F * side, 0.18F * swing + 0.04F, 0.50F);
    const Vec3 foot = body(0.10F * side, 0.30F * swing - 0.02F, 0.08F + 0.05F * std::abs(swing));
    add(hand, hip, 0.085F, knee, 0.06F, sleeve);
    add(hand, knee, 0.06F, foot, 0.045F, sleeve);
    add(hand, foot, 0.045F, foot + body.at.axes * Vec3(0.0F, 0.17F, -0.03F), 0.035F, sleeve);
}

void add_arm(Hand& hand, const Body& body, float side, float swing) {
    using enum HandMaterial;
    const Vec3 shoulder = body(0.20F * side, 0.0F, 1.40F);
    const Vec3 elbow = body(0.25F * side, 0.14F * swing - 0.03F, 1.12F);
    const Vec3 wrist = body(0.24F * side, 0.28F * swing + 0.08F, 0.90F);
    add(hand, shoulder, 0.055F, elbow, 0.045F, sleeve);
    add(hand, elbow, 0.045F, wrist, 0.035F, sleeve);
    add(hand, wrist, 0.035F, wrist + body.at.axes * Vec3(0.0F, 0.05F, -0.12F), 0.04F, skin);
}

}  // namespace

Person::Person(const CameraPath& path, double distance_m, int first_frame, std::uint64_t seed)
    : path_(path), distance_m_(distance_m), first_frame_(first_frame) {
    Random random(seed, 0x9e450);
    phase_rad_ = static_cast<double>(random.uniform(0.0F, 6.28F));
    period_frames_ = static_cast<double>(random.uniform(100.0F, 130.0F));
    shape_ = make_hand_shape(random, 1.0F);
}

Placement Person::place(double frame) const {
    // The camera's way without its tremor.
    Vector3d eye = Vector3d::Zero(), forward = Vector3d::Zero();
    constexpr int reach = 9;
    for (int i = -reach; i <= reach; ++i) {
        const Eigen::Isometry3d T_s_c = path_.at(std::max(static_cast<int>(frame) + i, 0));
        eye += T_s_c.translation() / (2 * reach + 1);
        forward += T_s_c.linear().col(2) / (2 * reach + 1);
    }
    forward.z() = 0.0;
    forward.normalize();
    const Vector3d aside(forward.y(), -forward.x(), 0.0);
    const double walk = tau * frame / period_frames_ + phase_rad_;
    const double come = std::clamp((frame - first_frame_) / entry_frames, 0.0, 1.0);
    const double outside_m =
        first_frame_ > 0 ? entry_m * static_cast<double>(1.0F - minimum_jerk(static_cast<float>(come))) : 0.0;
    const double sideways = 0.22 * distance_m_ * std::sin(walk) + outside_m;
    const double nearer = 0.10 * distance_m_ * std::sin(0.43 * walk);
    const Vector3d feet = eye + (distance_m_ - nearer) * forward + sideways * aside;
    // They look where they go, and a little to the camera.
    const double turn = std::cos(walk);
    const Vector3d ahead = (turn * aside - 0.45 * forward).normalized();
    Placement placement;
    placement.center = Vec3(static_cast<float>(feet.x()), static_cast<float>(feet.y()), 0.0F);
    placement.axes.col(2) = Vec3::UnitZ();
    placement.axes.col(1) = ahead.cast<float>();
    placement.axes.col(0) = placement.axes.col(2).cross(placement.axes.col(1)) * -1.0F;
    return placement;
}

Hand Person::at(int frame) const {
    const auto swing = static_cast<float>(std::sin(tau * frame / step_frames + phase_rad_));
    Body body{place(frame)};
    body.at.center.z() += 0.02F * std::abs(swing);
    Hand hand;
    add_trunk(hand, body);
    for (const float side : {-1.0F, 1.0F}) {
        add_leg(hand, body, side, side * swing);
        add_arm(hand, body, side, -side * swing);
    }
    return hand;
}

}  // namespace touchstone::sim
