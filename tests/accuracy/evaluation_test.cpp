#include "tests/accuracy/evaluation.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone {
namespace {

TEST(Evaluation, ASequenceIsASceneOfTheSimulator) {
    const SimulatorConfig config =
        parse_simulator_uri(scene_of({"curved", 7, 300, 1.4, 12.5, HandPlay::touching}));
    EXPECT_EQ(config.scene, SimulatedScene::curved);
    EXPECT_EQ(config.seed, 7U);
    EXPECT_EQ(config.frames, 300);
    EXPECT_EQ(config.hands, 2);
    EXPECT_EQ(config.height_m, 1.4);
    EXPECT_EQ(config.tilt_deg, 12.5);
    EXPECT_EQ(config.empty_s, 4.0) << "the slowest background needs 100 frames";
    EXPECT_EQ(config.sleeve, Sleeve::drawn);
    EXPECT_TRUE(config.human_timing);
    EXPECT_TRUE(config.drift);
    TableSequence steady;
    steady.drift = false;
    EXPECT_FALSE(parse_simulator_uri(scene_of(steady)).drift);
}

TEST(Evaluation, HandsTouchHoverOrAreNotThere) {
    const auto config_of = [](HandPlay hands) {
        return parse_simulator_uri(scene_of({"flat", 1, 300, 1.0, 25.0, hands}));
    };
    EXPECT_EQ(config_of(HandPlay::touching).gestures, Gestures::all);
    EXPECT_EQ(config_of(HandPlay::hovering).gestures, Gestures::hover);
    EXPECT_EQ(config_of(HandPlay::hovering_low).gestures, Gestures::low);
    EXPECT_EQ(config_of(HandPlay::none).hands, 0);
}

TEST(Evaluation, TiltsFillZeroToFortyDegrees) {
    std::set<int> fifths;
    for (int seed = 101; seed <= 110; ++seed) {
        const double tilt_deg = drawn_tilt_deg(seed);
        EXPECT_GE(tilt_deg, 0.0);
        EXPECT_LE(tilt_deg, 40.0);
        fifths.insert(static_cast<int>(tilt_deg / 8.0));
    }
    EXPECT_EQ(fifths.size(), 5U);
}

}  // namespace
}  // namespace touchstone
