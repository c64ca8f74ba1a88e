#include "platform/openni2_drivers/simulator/holding_hands.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "platform/openni2_drivers/simulator/object_mesh.hpp"

namespace touchstone::sim {
namespace {

using Eigen::Isometry3d;

double degrees_between(const Isometry3d& one, const Isometry3d& other) {
    return Eigen::AngleAxisd(one.linear().transpose() * other.linear()).angle() * 180.0 / std::numbers::pi;
}

TEST(TurnedObject, StrokesAreAsFastAsHandsAndPausesRest) {
    const TurnedObject turned(3);
    for (int frame = 1; frame <= TurnedObject::frames; ++frame) {
        const Isometry3d before = turned.at(frame - 1);
        const Isometry3d now = turned.at(frame);
        const int within = (frame - 1) % TurnedObject::period_frames;
        const bool pause = within < TurnedObject::pause_frames;
        const double deg = degrees_between(before, now);
        EXPECT_LT(deg, pause ? 0.2 : 2.0) << frame;
        if (within == 27) {
            EXPECT_NEAR(deg, 1.7, 0.2) << "in the middle of a stroke";
        }
        EXPECT_LT((now.translation() - before.translation()).norm(), 0.003);
        EXPECT_NEAR(now.translation().y(), 0.75, 0.02);
    }
}

TEST(TurnedObject, IsSeenFromAllSidesTopAndBottomIncluded) {
    const TurnedObject turned(1);
    // Every direction of the object is at some time within 50 degrees of the camera's.
    for (int polar = 0; polar <= 12; ++polar)
        for (int azimuth = 0; azimuth < 24; ++azimuth) {
            const double p = std::numbers::pi * polar / 12.0, a = std::numbers::pi * azimuth / 12.0;
            const Eigen::Vector3d d_o(std::sin(p) * std::cos(a), std::cos(p), std::sin(p) * std::sin(a));
            double most_cos = -1.0;
            for (int frame = 0; frame <= TurnedObject::frames; frame += 4)
                most_cos = std::max(most_cos, -(turned.at(frame).linear() * d_o).y());
            EXPECT_GT(most_cos, std::cos(50.0 * std::numbers::pi / 180.0)) << polar << ' ' << azimuth;
        }
    // Upright at the start, its front to the camera.
    EXPECT_GT((turned.at(0).linear() * Eigen::Vector3d::UnitY()).z(), 0.99);
    EXPECT_LT((turned.at(0).linear() * Eigen::Vector3d::UnitZ()).y(), -0.99);
}

TEST(TurnedObject, PlaysToAndFro) {
    EXPECT_EQ(TurnedObject::folded(5), 5);
    EXPECT_EQ(TurnedObject::folded(TurnedObject::frames), TurnedObject::frames);
    EXPECT_EQ(TurnedObject::folded(TurnedObject::frames + 3), TurnedObject::frames - 3);
    EXPECT_EQ(TurnedObject::folded(2 * TurnedObject::frames + 4), 4);
}

class HoldingHandsOnABowl : public testing::Test {
  protected:
    /// Distance of the fingertips' middles from the bowl: the index's and the thumb's.
    double tip_distance_m(const Hand& hand, int frame) const {
        const Isometry3d T_o_w = turned_.at(frame).inverse();
        return std::max(surface_.distance_m(T_o_w * hand.index().a.cast<double>()),
                        surface_.distance_m(T_o_w * hand.thumb().a.cast<double>()));
    }

    TriangleMesh bowl_ = make_bowl();
    TurnedObject turned_{2};
    MeshDistance surface_{bowl_};
    HoldingHands hands_{bowl_, turned_, 2};
};

TEST_F(HoldingHandsOnABowl, OneAlwaysHoldsAndTheOtherComesOff) {
    std::array<double, 2> farthest_m{};
    std::array<int, 2> changes{};
    for (int frame = 0; frame <= TurnedObject::frames; ++frame) {
        EXPECT_FALSE(HoldingHands::changes(0, frame) && HoldingHands::changes(1, frame)) << frame;
        for (int hand = 0; hand < 2; ++hand) {
            const double distance_m = tip_distance_m(hands_.at(hand, frame), frame);
            if (!HoldingHands::changes(hand, frame)) {
                EXPECT_NEAR(distance_m, 0.008, 1e-4) << "fingertips of 8 mm touch; frame " << frame;
                continue;
            }
            const auto i = static_cast<std::size_t>(hand);
            farthest_m[i] = std::max(farthest_m[i], distance_m);
            changes[i] += frame % TurnedObject::period_frames == 0;
        }
    }
    for (const double distance_m : farthest_m) EXPECT_GT(distance_m, 0.05);
    EXPECT_EQ(changes[0], 6);
    EXPECT_EQ(changes[1], 7);
}

TEST_F(HoldingHandsOnABowl, MoveAsFastAsHands) {
    for (int frame = 1; frame <= TurnedObject::frames; ++frame)
        for (int hand = 0; hand < 2; ++hand) {
            const Hand before = hands_.at(hand, frame - 1);
            const Hand now = hands_.at(hand, frame);
            for (std::size_t part = 0; part < now.parts.size(); ++part)
                EXPECT_LT((now.parts[part].cone.a - before.parts[part].cone.a).norm(), 0.07F) << frame;
        }
}

TEST_F(HoldingHandsOnABowl, ArmsReachOutOfThePicture) {
    for (int hand = 0; hand < 2; ++hand) {
        const Vec3 elbow = hands_.at(hand, 100).parts.back().cone.b;
        EXPECT_GT(std::abs(elbow.x() / elbow.y()), 320.0F / 575.8F + 0.1F);
    }
    EXPECT_EQ(hands_.shape(0).skin, hands_.shape(1).skin) << "one person";
    EXPECT_EQ(hands_.shape(0).sleeve, hands_.shape(1).sleeve);
}

}  // namespace
}  // namespace touchstone::sim
