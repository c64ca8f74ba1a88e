#include "platform/openni2_drivers/simulator/hand_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone::sim {
namespace {

constexpr float mm = 1e-3F;

/// The palm's frame: origin at the knuckle of the index.
struct Palm {
    Vec3 knuckle, forward, outer, up;  ///< outer: towards the little finger
    float pitch_rad;
    float unit;  ///< metres per millimetre of the model hand

    Vec3 at(float forward_mm, float outer_mm, float up_mm) const {
        return knuckle + unit * (forward_mm * forward + outer_mm * outer + up_mm * up);
    }
};

struct IndexFinger {
    Vec3 tip, first, second, knuckle;
};

IndexFinger index_finger(const HandShape& shape, const HandPosture& posture) {
    const float unit = mm * shape.scale;
    IndexFinger finger;
    finger.tip = posture.index_tip;
    finger.first = finger.tip - 24.0F * unit * pointing(posture.yaw_rad, posture.pitch_rad);
    finger.second =
        finger.first - 25.0F * unit * pointing(posture.yaw_rad, posture.pitch_rad - 0.35F * posture.bend_rad);
    finger.knuckle =
        finger.second - 43.0F * unit * pointing(posture.yaw_rad, posture.pitch_rad - posture.bend_rad);
    return finger;
}

Palm palm_of(const HandShape& shape, const HandPosture& posture, const Vec3& knuckle) {
    const float pitch =
        std::clamp(posture.pitch_rad - posture.bend_rad - radians(20.0F), radians(2.0F), radians(28.0F));
    const Vec3 right(std::sin(posture.yaw_rad), -std::cos(posture.yaw_rad), 0.0F);
    const Vec3 forward = pointing(posture.yaw_rad, pitch);
    return {knuckle, forward, shape.side * right, right.cross(forward), pitch, mm * shape.scale};
}

void add(Hand& hand, const Vec3& a, float radius_a, const Vec3& b, float radius_b, float clearance_m,
         HandMaterial material = HandMaterial::skin) {
    hand.parts.push_back({{a, b, radius_a, radius_b}, material, clearance_m, false});
}

/// Knee of a two-link chain from `base` to `tip`, bent towards `pole`. Moves a tip out of reach into it.
Vec3 bend_towards(const Vec3& base, Vec3& tip, float first_m, float second_m, const Vec3& pole) {
    const Vec3 span = tip - base;
    const float reach =
        std::clamp(span.norm(), 1.05F * std::abs(first_m - second_m), 0.985F * (first_m + second_m));
    const Vec3 along = span.normalized();
    tip = base + reach * along;
    const float foot = (reach * reach + first_m * first_m - second_m * second_m) / (2.0F * reach);
    const Vec3 aside = (pole - pole.dot(along) * along).normalized();
    return base + foot * along + std::sqrt(std::max(0.0F, first_m * first_m - foot * foot)) * aside;
}

void add_index(Hand& hand, const HandShape& shape, const IndexFinger& finger) {
    const float r = shape.fingertip_radius_m;
    add(hand, finger.first, 1.1F * r, finger.second, 1.2F * r, 0.001F);
    add(hand, finger.second, 1.2F * r, finger.knuckle, 1.4F * r, 0.002F);
}

/// The last joint goes to parts[1]; the tip may be anywhere in reach of the ball of the thumb.
void add_thumb(Hand& hand, const HandShape& shape, const Palm& palm, Vec3 tip, bool touches) {
    const float r = 1.2F * shape.fingertip_radius_m;
    const Vec3 base = palm.at(-48.0F, -8.0F, -12.0F);
    const Vec3 pole = palm.up * 0.6F - palm.outer;
    const Vec3 knee = bend_towards(base, tip, 48.0F * palm.unit, 66.0F * palm.unit, pole);
    const Vec3 bow =
        4.0F * palm.unit * (pole - pole.dot(tip - knee) / (tip - knee).squaredNorm() * (tip - knee));
    const Vec3 joint = knee + 0.55F * (tip - knee) + bow;
    HandPart& last = hand.parts[1];
    last = {{tip, joint, r, 1.05F * r}, HandMaterial::skin, touches ? 0.001F : 0.012F, touches};
    add(hand, joint, 1.05F * r, knee, 1.15F * r, touches ? 0.002F : 0.008F);
    add(hand, knee, 1.15F * r, base, 1.5F * r, 0.004F);
    add(hand, base, 1.6F * r, palm.at(-20.0F, 3.0F, -5.0F), 1.2F * r, 0.004F);
}

struct FingerSize {
    float forward_mm, outer_mm, up_mm;  ///< knuckle in the palm
    std::array<float, 3> length_mm;
    float thickness;  ///< times the index
};

constexpr std::array<FingerSize, 3> other_fingers{{{4.0F, 20.0F, 2.0F, {44.0F, 28.0F, 23.0F}, 1.05F},
                                                   {-1.0F, 39.0F, 0.0F, {41.0F, 26.0F, 22.0F}, 1.0F},
                                                   {-11.0F, 55.0F, -5.0F, {33.0F, 20.0F, 19.0F}, 0.87F}}};

/// Middle, ring and little finger: they stay 12 mm clear, so that only fingers in use can be taken for
/// touching.
void add_other_fingers(Hand& hand, const HandShape& shape, const HandPosture& posture, const Palm& palm) {
    constexpr std::array<float, 3> stretched{-10.0F, 10.0F, 8.0F};
    constexpr std::array<float, 3> curled{55.0F, 105.0F, 60.0F};
    for (const FingerSize& size : other_fingers) {
        const float spread = shape.side * -0.08F * (size.outer_mm - 20.0F) / 20.0F * (1.0F - posture.curl);
        Vec3 from = palm.at(size.forward_mm, size.outer_mm, size.up_mm);
        float pitch = palm.pitch_rad;
        float radius = 1.35F * size.thickness * shape.fingertip_radius_m;
        for (std::size_t joint = 0; joint < 3; ++joint) {
            pitch += radians(stretched[joint] + posture.curl * (curled[joint] - stretched[joint]));
            const Vec3 to =
                from + size.length_mm[joint] * palm.unit * pointing(posture.yaw_rad + spread, pitch);
            const float next = radius * 0.9F;
            add(hand, to, next, from, radius, 0.012F);
            from = to;
            radius = next;
        }
    }
}

/// The back of the hand, down to the wrist.
void add_palm(Hand& hand, const Palm& palm) {
    const float u = palm.unit;
    add(hand, palm.at(0, 0, -2), 11 * u, palm.at(-66, 8, -6), 14 * u, 0.004F);
    add(hand, palm.at(4, 20, 0), 11 * u, palm.at(-68, 19, -4), 15 * u, 0.004F);
    add(hand, palm.at(-1, 39, -2), 10.5F * u, palm.at(-70, 31, -5), 15 * u, 0.004F);
    add(hand, palm.at(-11, 55, -6), 9.5F * u, palm.at(-70, 41, -8), 13 * u, 0.004F);
    add(hand, palm.at(-12, 26, -6), 13 * u, palm.at(-60, 26, -8), 17 * u, 0.004F);
    add(hand, palm.at(-62, 14, -7), 16 * u, palm.at(-92, 18, -7), 17 * u, 0.004F);
    add(hand, palm.at(-62, 36, -8), 15 * u, palm.at(-92, 32, -7), 16 * u, 0.004F);
}

void add_arm(Hand& hand, const HandShape& shape, const Palm& palm, const Vec3& shoulder_s) {
    using enum HandMaterial;
    const Vec3 wrist = palm.at(-90.0F, 25.0F, -7.0F);
    const Vec3 outward = palm.outer;
    Vec3 shoulder = shoulder_s;
    const float lower = 0.25F * shape.scale;
    const Vec3 elbow = bend_towards(wrist, shoulder, lower, 0.29F * shape.scale, outward + Vec3(0, 0, 0.1F));
    const Vec3 cuff = wrist + 0.3F * (elbow - wrist);
    const float u = palm.unit;
    add(hand, wrist, 23 * u, cuff + 0.03F * (elbow - wrist), 29 * u, 0.005F);
    const float wide = shape.sleeve_mm;
    add(hand, cuff, (29 + wide) * u, elbow, (39 + wide) * u, 0.005F, sleeve);
    add(hand, elbow, (39 + wide) * u, shoulder, (50 + wide) * u, 0.005F, sleeve);
    if ((shoulder - shoulder_s).norm() > 0.01F)
        add(hand, shoulder, (50 + wide) * u, shoulder_s, (54 + wide) * u, 0.005F, sleeve);
}

}  // namespace

Vec3 pointing(float yaw_rad, float pitch_rad) {
    return {std::cos(yaw_rad) * std::cos(pitch_rad), std::sin(yaw_rad) * std::cos(pitch_rad),
            -std::sin(pitch_rad)};
}

HandShape make_hand_shape(Random& random, float side) {
    constexpr std::array<std::array<float, 3>, 4> skins{
        {{0.90F, 0.68F, 0.56F}, {0.82F, 0.60F, 0.46F}, {0.62F, 0.42F, 0.30F}, {0.42F, 0.28F, 0.21F}}};
    HandShape shape;
    shape.side = side;
    shape.fingertip_radius_m = random.uniform(0.006F, 0.009F);
    shape.scale = random.uniform(0.92F, 1.08F);
    shape.skin = Vec3(skins[static_cast<std::size_t>(random.below(4))].data());
    shape.sleeve = {random.uniform(0.1F, 0.7F), random.uniform(0.1F, 0.6F), random.uniform(0.15F, 0.7F)};
    return shape;
}

Hand build_hand(const HandShape& shape, const HandPosture& posture, const Vec3& shoulder_s,
                bool thumb_touches) {
    const IndexFinger index = index_finger(shape, posture);
    const Palm palm = palm_of(shape, posture, index.knuckle);
    const float r = shape.fingertip_radius_m;
    Hand hand;
    hand.parts.reserve(32);
    hand.parts.push_back({{index.tip, index.first, r, 1.1F * r}, HandMaterial::skin, 0.001F, true});
    hand.parts.emplace_back();
    add_thumb(hand, shape, palm, posture.thumb_tip, thumb_touches);
    add_index(hand, shape, index);
    add_other_fingers(hand, shape, posture, palm);
    add_palm(hand, palm);
    add_arm(hand, shape, palm, shoulder_s);
    return hand;
}

Vec3 relaxed_thumb_tip(const HandShape& shape, const HandPosture& posture) {
    return palm_of(shape, posture, index_finger(shape, posture).knuckle).at(0.0F, -32.0F, -12.0F);
}

}  // namespace touchstone::sim
