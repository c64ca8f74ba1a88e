#include "platform/openni2_drivers/simulator/holding_hands.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone::sim {
namespace {

constexpr float tip_radius_m = 0.008F;

/// Where the elbow is, out of the picture: frame w.
Vec3 elbow_w(int hand) {
    const float side = hand == 0 ? -1.0F : 1.0F;
    return {side * 0.66F, static_cast<float>(TurnedObject::distance_m), -0.24F};
}

}  // namespace

bool HoldingHands::changes(int hand, int frame) {
    const int pause = frame / TurnedObject::period_frames;
    return pause > 0 && pause < TurnedObject::strokes && pause % 2 == hand &&
           frame % TurnedObject::period_frames < TurnedObject::pause_frames;
}

HoldingHands::HoldingHands(const TriangleMesh& mesh, const TurnedObject& turned, std::uint64_t seed)
    : turned_(turned) {
    const MeshDistance surface(mesh);
    for (int hand = 0; hand < 2; ++hand) {
        Random random(seed, 0x6417 + static_cast<std::uint64_t>(hand));
        shapes_[static_cast<std::size_t>(hand)] = make_hand_shape(random, hand == 0 ? -1.0F : 1.0F);
        int from = 0;
        for (int pause = 1; pause <= TurnedObject::strokes; ++pause) {
            const int begins = pause * TurnedObject::period_frames;
            if (pause < TurnedObject::strokes && !changes(hand, begins)) continue;
            grips_[static_cast<std::size_t>(hand)].push_back(take_hold(surface, hand, from, begins, random));
            from = begins + TurnedObject::pause_frames;
        }
        grips_[static_cast<std::size_t>(hand)].back().until_frame = TurnedObject::frames;
    }
    shapes_[1].skin = shapes_[0].skin;
    shapes_[1].sleeve = shapes_[0].sleeve;
}

HoldingHands::Grip HoldingHands::take_hold(const MeshDistance& surface, int hand, int from_frame,
                                           int until_frame, Random& random) const {
    // Comfortable in the middle of the time that it holds.
    const Eigen::Isometry3f T_o_w = turned_.at(0.5 * (from_frame + until_frame)).inverse().cast<float>();
    const float rise = random.uniform(-0.35F, 0.35F);
    const float back = random.uniform(-0.1F, 0.25F);
    const Vec3 outward_w = Vec3(hand == 0 ? -1.0F : 1.0F, back, rise).normalized();
    const Vec3 front_w = (-Vec3::UnitY() + outward_w.y() * outward_w).normalized();
    const Vec3 d = T_o_w.linear() * outward_w;
    const Vec3 front = T_o_w.linear() * front_w;
    const Vec3 aside = d.cross(front);
    const auto nearest = [&](const Vec3& point) -> Vec3 {
        return surface.nearest(point.cast<double>()).point.cast<float>();
    };
    // No surface is nearer to a point far out than this one: around it there is room for the fingertips.
    const Vec3 middle = nearest(0.6F * d);
    Grip grip;
    grip.until_frame = until_frame;
    grip.outward = d;
    grip.wrist = middle + 0.165F * d;
    for (std::size_t i = 0; i < 5; ++i) {
        const float place = i == 0 ? 0.0F : static_cast<float>(i) - 2.5F;
        const float face = i == 0 ? 1.0F : -1.0F;
        const Vec3 seed = middle + 0.015F * d + 0.028F * face * front + 0.021F * place * aside;
        const Vec3 touched = nearest(seed);
        grip.tips[i] = touched + tip_radius_m * (seed - touched).normalized();
        grip.knuckles[i] = middle + 0.085F * d + 0.018F * face * front + 0.019F * place * aside;
        grip.joints[i] = 0.5F * (grip.tips[i] + grip.knuckles[i]) + 0.014F * face * front;
    }
    return grip;
}

HoldingHands::Grip HoldingHands::moved(const Grip& grip, const Eigen::Isometry3f& T) {
    Grip out = grip;
    for (auto* points : {&out.tips, &out.joints, &out.knuckles})
        for (Vec3& point : *points) point = (T * point).eval();
    out.wrist = T * grip.wrist;
    out.outward = T.linear() * grip.outward;
    return out;
}

HoldingHands::Grip HoldingHands::between(const Grip& from, const Grip& to, float share) {
    const float eased = minimum_jerk(share);
    // Away from the object in the middle of the way.
    const Vec3 retreat = 0.26F * share * (1.0F - share) * (from.outward + to.outward).normalized();
    const auto mixed = [&](const Vec3& one, const Vec3& other) -> Vec3 {
        return one + eased * (other - one) + retreat;
    };
    Grip out = from;
    for (std::size_t i = 0; i < 5; ++i) {
        out.tips[i] = mixed(from.tips[i], to.tips[i]);
        out.joints[i] = mixed(from.joints[i], to.joints[i]);
        out.knuckles[i] = mixed(from.knuckles[i], to.knuckles[i]);
    }
    out.wrist = mixed(from.wrist, to.wrist);
    return out;
}

Hand HoldingHands::at(int hand, int frame) const {
    const std::vector<Grip>& grips = grips_[static_cast<std::size_t>(hand)];
    const Eigen::Isometry3f T_w_o = turned_.at(frame).cast<float>();
    std::size_t number = 0;
    while (number + 1 < grips.size() && frame >= grips[number].until_frame + TurnedObject::pause_frames)
        ++number;
    const Grip now = moved(grips[number], T_w_o);
    if (!changes(hand, frame)) return build(now, hand);
    const float share =
        (static_cast<float>(frame - grips[number].until_frame) + 0.5F) / TurnedObject::pause_frames;
    return build(between(now, moved(grips[number + 1], T_w_o), share), hand);
}

Hand HoldingHands::build(const Grip& grip_w, int hand) const {
    Hand built;
    const auto add = [&](const Vec3& a, float radius_a, const Vec3& b, float radius_b,
                         HandMaterial material = HandMaterial::skin) {
        built.parts.push_back({{a, b, radius_a, radius_b}, material, 0.0F, false});
    };
    // parts[0] is the index's last joint, parts[1] the thumb's.
    for (const std::size_t i : {1U, 0U, 2U, 3U, 4U})
        add(grip_w.tips[i], tip_radius_m, grip_w.joints[i], 0.009F);
    for (std::size_t i = 0; i < 5; ++i) {
        add(grip_w.joints[i], 0.009F, grip_w.knuckles[i], 0.011F);
        add(grip_w.knuckles[i], 0.013F, grip_w.wrist, 0.020F);
    }
    const Vec3 elbow = elbow_w(hand);
    const Vec3 cuff = grip_w.wrist + 0.3F * (elbow - grip_w.wrist);
    add(grip_w.wrist, 0.024F, cuff, 0.029F);
    add(cuff, 0.036F, elbow, 0.046F, HandMaterial::sleeve);
    return built;
}

}  // namespace touchstone::sim
