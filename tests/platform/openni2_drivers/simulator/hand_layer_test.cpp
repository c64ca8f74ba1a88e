#include "platform/openni2_drivers/simulator/hand_layer.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace touchstone::sim {
namespace {

HandPosture pointing_at(const Vec3& tip_s, const HandShape& shape) {
    HandPosture posture;
    posture.index_tip = tip_s;
    posture.yaw_rad = 1.4F;
    posture.thumb_tip = relaxed_thumb_tip(shape, posture);
    return posture;
}

struct Drawn {
    TableView view = make_table_view(1.0, 25.0);
    HandShape shape;
    Hand hand = build_hand(shape, pointing_at({0.05F, 0.0F, 0.01F}, shape), {0.1F, -0.6F, 0.4F}, false);
    Picture picture;

    Drawn() {
        clear_picture(picture, std::vector<float>(640 * 480, 5.0F));
        draw_hand(picture, hand, 1, view);
    }
};

/// Depth of a part along a pixel's ray, drawn the slow way; infinity where the ray misses.
float depth_by_part(const Drawn& drawn, const HandPart& part, const Vec3& ray) {
    const RoundCone cone{drawn.view.to_camera(part.cone.a), drawn.view.to_camera(part.cone.b),
                         part.cone.radius_a, part.cone.radius_b};
    const float z = ConeTracer(cone)(ray);
    return z > 0.0F ? z : 1e9F;
}

TEST(HandLayer, SpansMissNoPixelOfAnyPart) {
    const Drawn drawn;
    for (int v = 0; v < 480; v += 3)
        for (int u = 0; u < 640; u += 3) {
            float nearest = 5.0F;
            for (const HandPart& part : drawn.hand.parts)
                nearest = std::min(
                    nearest, depth_by_part(drawn, part,
                                           drawn.view.ray_c(static_cast<float>(u), static_cast<float>(v))));
            EXPECT_FLOAT_EQ(drawn.picture.depth_m[static_cast<std::size_t>(v * 640 + u)], nearest)
                << u << ' ' << v;
        }
}

TEST(HandLayer, ThePartSaysWhatIsInFront) {
    const Drawn drawn;
    int shown = 0;
    for (std::size_t i = 0; i < drawn.picture.part.size(); ++i) {
        EXPECT_EQ(drawn.picture.part[i] != 0, drawn.picture.depth_m[i] < 5.0F);
        if (drawn.picture.part[i] == 0) continue;
        EXPECT_EQ(drawn.picture.owner[i], 1);
        ++shown;
    }
    EXPECT_GT(shown, 8000);
}

TEST(HandLayer, TheHandReachesTheEdgeOfThePicture) {
    const Drawn drawn;
    const auto last_row = drawn.picture.part.end() - 640;
    EXPECT_GT(std::count_if(last_row, drawn.picture.part.end(), [](std::uint8_t part) { return part != 0; }),
              30);
}

TEST(HandModel, LeftAndRightAreMirrored) {
    HandShape right;
    HandShape left;
    left.side = -1.0F;
    HandPosture posture = pointing_at({0.0F, 0.0F, 0.01F}, right);
    posture.yaw_rad = radians(90.0F);
    posture.thumb_tip = relaxed_thumb_tip(right, posture);
    HandPosture mirrored = posture;
    mirrored.thumb_tip = relaxed_thumb_tip(left, mirrored);
    const Hand one = build_hand(right, posture, {0.0F, -0.6F, 0.4F}, false);
    const Hand two = build_hand(left, mirrored, {0.0F, -0.6F, 0.4F}, false);
    EXPECT_LT(one.thumb().a.x(), -0.01F) << "the right thumb is on the left";
    for (std::size_t i = 0; i < one.parts.size(); ++i) {
        const Vec3 flipped = two.parts[i].cone.a.cwiseProduct(Vec3(-1.0F, 1.0F, 1.0F));
        EXPECT_LT((one.parts[i].cone.a - flipped).norm(), 1e-5F) << i;
    }
}

TEST(HandModel, AThumbInReachEndsWhereItIsAskedTo) {
    const HandShape shape;
    HandPosture posture = pointing_at({0.0F, 0.0F, 0.008F}, shape);
    posture.thumb_tip = relaxed_thumb_tip(shape, posture) + Vec3(0.0F, 0.01F, -0.02F);
    const Hand near = build_hand(shape, posture, {0.0F, -0.6F, 0.4F}, true);
    EXPECT_LT((near.thumb().a - posture.thumb_tip).norm(), 1e-6F);
    posture.thumb_tip = Vec3(0.3F, 0.3F, 0.0F);
    const Hand far = build_hand(shape, posture, {0.0F, -0.6F, 0.4F}, true);
    EXPECT_LT((far.thumb().a - far.index().a).norm(), 0.2F) << "a thumb does not stretch";
}

}  // namespace
}  // namespace touchstone::sim
