#include "platform/openni2_drivers/simulator/simulator_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

/// The message that refuses the URI; empty when it is taken.
std::string refusal(const char* uri) {
    try {
        parse_simulator_uri(uri);
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::usage);
        return error.what();
    }
    return "";
}

TEST(SimulatorConfig, TheSceneAloneGivesTheDefaults) {
    const SimulatorConfig config = parse_simulator_uri("bowl");
    EXPECT_EQ(config.scene, SimulatedScene::bowl);
    EXPECT_EQ(config.hands, 1);
    EXPECT_EQ(config.frames, 0);
    EXPECT_TRUE(config.noise);
    EXPECT_TRUE(config.drift);
    EXPECT_TRUE(config.human_timing);
    EXPECT_DOUBLE_EQ(config.height_m, 1.0);
    EXPECT_DOUBLE_EQ(config.tilt_deg, 25.0);
    EXPECT_DOUBLE_EQ(config.empty_s, 2.5);
}

TEST(SimulatorConfig, NoSceneIsTheMixedOne) {
    EXPECT_EQ(parse_simulator_uri("").scene, SimulatedScene::mixed);
}

TEST(SimulatorConfig, ReadsEveryKey) {
    const SimulatorConfig config = parse_simulator_uri(
        "curved?seed=7&hands=2&frames=90&noise=1&drift=0&human=0&truth=/tmp/t.json&masks=/tmp/"
        "m&height=0.8&tilt=0&"
        "empty=0.5&rate=60");
    EXPECT_EQ(config.scene, SimulatedScene::curved);
    EXPECT_EQ(config.seed, 7U);
    EXPECT_EQ(config.hands, 2);
    EXPECT_EQ(config.frames, 90);
    EXPECT_TRUE(config.noise);
    EXPECT_FALSE(config.drift);
    EXPECT_FALSE(config.human_timing);
    EXPECT_EQ(config.truth_path, "/tmp/t.json");
    EXPECT_EQ(config.masks_folder, "/tmp/m");
    EXPECT_DOUBLE_EQ(config.height_m, 0.8);
    EXPECT_DOUBLE_EQ(config.tilt_deg, 0.0);
    EXPECT_DOUBLE_EQ(config.empty_s, 0.5);
    EXPECT_DOUBLE_EQ(config.rate_hz, 60.0);
}

TEST(SimulatorConfig, ReadsWhatHandsWearAndDo) {
    EXPECT_EQ(parse_simulator_uri("flat").sleeve, Sleeve::loose);
    EXPECT_EQ(parse_simulator_uri("flat").gestures, Gestures::all);
    EXPECT_EQ(parse_simulator_uri("flat?sleeve=tight").sleeve, Sleeve::tight);
    EXPECT_EQ(parse_simulator_uri("flat?sleeve=drawn").sleeve, Sleeve::drawn);
    EXPECT_EQ(parse_simulator_uri("flat?gestures=hover").gestures, Gestures::hover);
    EXPECT_EQ(parse_simulator_uri("flat?gestures=low").gestures, Gestures::low);
    EXPECT_THAT(refusal("flat?sleeve=wide"), testing::HasSubstr("loose, tight or drawn"));
    EXPECT_THAT(refusal("flat?gestures=none"), testing::HasSubstr("all, hover or low"));
    EXPECT_THAT(refusal("room?sleeve=tight"), testing::HasSubstr("not for the scene"));
}

TEST(SimulatorConfig, DriftFollowsNoiseWhateverTheOrder) {
    EXPECT_FALSE(parse_simulator_uri("flat?noise=0").drift);
    EXPECT_TRUE(parse_simulator_uri("flat?drift=1&noise=0").drift);
}

TEST(SimulatorConfig, ReadsTheKeysOfAMovingCamera) {
    EXPECT_EQ(parse_simulator_uri("room").motion, CameraMotion::still);
    const SimulatorConfig config =
        parse_simulator_uri("room?motion=rpy&seed=2&frames=9&noise=0&poses=/tmp/p.txt");
    EXPECT_EQ(config.scene, SimulatedScene::room);
    EXPECT_EQ(config.motion, CameraMotion::rpy);
    EXPECT_EQ(config.poses_path, "/tmp/p.txt");
    EXPECT_EQ(config.frames, 9);
    EXPECT_FALSE(config.drift);
    EXPECT_EQ(config.person, 0.0);
    EXPECT_EQ(parse_simulator_uri("room?person=0.25&masks=/tmp/m").person, 0.25);
    EXPECT_EQ(parse_simulator_uri("room?person=0.25&person_s=2.5").person_s, 2.5);
    EXPECT_EQ(parse_simulator_uri("wall?motion=slide").motion, CameraMotion::slide);
    EXPECT_EQ(parse_simulator_uri("wall?motion=sweep").motion, CameraMotion::sweep);
    EXPECT_EQ(parse_simulator_uri("wall?motion=orbit").scene, SimulatedScene::wall);
}

TEST(SimulatorConfig, ReadsTheKeysOfAnObjectAndOfAKnock) {
    const SimulatorConfig plain = parse_simulator_uri("object");
    EXPECT_EQ(plain.scene, SimulatedScene::object);
    EXPECT_TRUE(plain.mesh_path.empty());
    EXPECT_FALSE(plain.fingers);
    EXPECT_DOUBLE_EQ(plain.size_m, 0.25);
    EXPECT_DOUBLE_EQ(plain.knock_deg, 0.0);
    EXPECT_DOUBLE_EQ(plain.knock_mm, 0.0);
    const SimulatorConfig config = parse_simulator_uri(
        "object?mesh=/tmp/a.obj&size_m=0.3&grip=fingers&knock_s=7.5&knock_deg=4&knock_mm=30&masks=/tmp/m");
    EXPECT_EQ(config.mesh_path, "/tmp/a.obj");
    EXPECT_DOUBLE_EQ(config.size_m, 0.3);
    EXPECT_TRUE(config.fingers);
    EXPECT_DOUBLE_EQ(config.knock_s, 7.5);
    EXPECT_DOUBLE_EQ(config.knock_deg, 4.0);
    EXPECT_DOUBLE_EQ(config.knock_mm, 30.0);
    EXPECT_FALSE(parse_simulator_uri("object?grip=none").fingers);
    EXPECT_DOUBLE_EQ(parse_simulator_uri("bowl?knock_deg=5").knock_deg, 5.0);
}

TEST(SimulatorConfig, RefusesKeysOfOtherScenes) {
    using testing::AllOf;
    using testing::HasSubstr;
    EXPECT_THAT(refusal("room?motion=fly"),
                AllOf(HasSubstr("motion"), HasSubstr("still, sweep"), HasSubstr("'fly'")));
    EXPECT_THAT(refusal("flat?motion=sweep"), HasSubstr("key motion is not for the scene flat"));
    EXPECT_THAT(refusal("wall?hands=1"), HasSubstr("key hands is not for the scene wall"));
    EXPECT_THAT(refusal("room?truth=/tmp/t"), HasSubstr("key truth is not for the scene room"));
    EXPECT_THAT(refusal("object?motion=still"), HasSubstr("key motion is not for the scene object"));
    EXPECT_THAT(refusal("bowl?mesh=/tmp/a.obj"), HasSubstr("key mesh is not for the scene bowl"));
    EXPECT_THAT(refusal("flat?person=0.2"), HasSubstr("key person is not for the scene flat"));
    EXPECT_THAT(refusal("object?person=0.2"), HasSubstr("key person is not for the scene object"));
    EXPECT_THAT(refusal("room?person=0.7"),
                AllOf(HasSubstr("person"), HasSubstr("0 to 0.6"), HasSubstr("'0.7'")));
    EXPECT_THAT(refusal("object?grip=tongs"), AllOf(HasSubstr("none or fingers"), HasSubstr("'tongs'")));
    EXPECT_THAT(refusal("object?size_m=3"), AllOf(HasSubstr("size_m"), HasSubstr("0.02 to 0.5")));
    EXPECT_THAT(refusal("flat?knock_deg=-1"), AllOf(HasSubstr("knock_deg"), HasSubstr("0 to 180")));
    EXPECT_THAT(refusal("room?poses="), HasSubstr("key poses needs a path"));
}

TEST(SimulatorConfig, RefusalsNameTheKeyAndTheRange) {
    using testing::AllOf;
    using testing::HasSubstr;
    EXPECT_THAT(
        refusal("moon"),
        AllOf(HasSubstr("moon"), HasSubstr("flat, curved, cluttered, bowl, mixed, room, wall or object")));
    EXPECT_THAT(refusal("flat?fingers=2"), AllOf(HasSubstr("fingers"), HasSubstr("seed, hands, frames")));
    EXPECT_THAT(refusal("flat?hands=3"), AllOf(HasSubstr("hands"), HasSubstr("0 to 2"), HasSubstr("'3'")));
    EXPECT_THAT(refusal("flat?height=0.2"), AllOf(HasSubstr("height"), HasSubstr("0.5 to 1.6")));
    EXPECT_THAT(refusal("flat?height=nan"), HasSubstr("height"));
    EXPECT_THAT(refusal("flat?tilt=46"), AllOf(HasSubstr("tilt"), HasSubstr("0 to 45")));
    EXPECT_THAT(refusal("flat?noise=yes"), AllOf(HasSubstr("noise"), HasSubstr("0 or 1")));
    EXPECT_THAT(refusal("flat?seed=-1"), HasSubstr("seed"));
    EXPECT_THAT(refusal("flat?seed=1x"), HasSubstr("seed"));
    EXPECT_THAT(refusal("flat?frames="), HasSubstr("frames"));
    EXPECT_THAT(refusal("flat?truth="), HasSubstr("truth"));
    EXPECT_THAT(refusal("flat?seed"), HasSubstr("key=value"));
    EXPECT_THAT(refusal("flat?a\nb\x1b[2J=1"), HasSubstr("'a?b?[2J'"))
        << "one line, and no orders to a terminal";
    EXPECT_EQ(refusal("flat?seed=3&rate=120"), "");
}

}  // namespace
}  // namespace touchstone
