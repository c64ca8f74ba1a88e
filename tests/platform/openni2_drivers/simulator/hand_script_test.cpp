#include "platform/openni2_drivers/simulator/hand_script.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/static_layer.hpp"

namespace touchstone::sim {
namespace {

/// One table with two hands, as the source sets it up.
struct Table {
    explicit Table(const SimulatorConfig& given)
        : config(given),
          view(make_table_view(config.height_m, config.tilt_deg)),
          scene(make_scene(config.scene, config.seed, view.on_table(639.0F, 239.5F).x())),
          depth_m(render_static_depth(scene, view)) {}

    HandScript script(int hand, float half) const {
        return {config, Workplace{scene, view, depth_m, half}, hand};
    }

    SimulatorConfig config;
    TableView view;
    Scene scene;
    std::vector<float> depth_m;
};

SimulatorConfig config_of(SimulatedScene scene, std::uint64_t seed) {
    SimulatorConfig config;
    config.scene = scene;
    config.seed = seed;
    return config;
}

/// What a minute of one hand shows, in frames of 30 Hz.
struct Minute {
    int contacts = 0;
    int short_contacts = 0;  ///< in one frame only
    int thumb_contacts = 0;
    int longest_frames = 0;
    float dragged_m = 0.0F;  ///< by the index, in contact
    float deepest_m = 0.0F;  ///< of any part in the scene
    float worst_contact_m = 0.0F;
    float highest_speed_m_s = 0.0F;
    bool crossed = false;  ///< any part left the hand's half
};

void look_at_parts(const Hand& hand, const Scene& scene, float half, Minute& minute) {
    for (const HandPart& part : hand.parts)
        for (int i = 0; i <= 10; ++i) {
            const float share = 0.1F * static_cast<float>(i);
            const Vec3 middle = part.cone.a + share * (part.cone.b - part.cone.a);
            const float radius = part.cone.radius_a + share * (part.cone.radius_b - part.cone.radius_a);
            minute.deepest_m = std::max(minute.deepest_m, -gap_m(scene, middle, radius));
            minute.crossed = minute.crossed || half * middle.x() < radius;
        }
}

class Contacts {
  public:
    void look(const HandMoment& moment, const Scene& scene, Minute& minute) {
        const Hand& hand = moment.hand;
        look_at_tip(0, hand.index(), true, scene, minute);
        look_at_tip(1, hand.thumb(), moment.thumb_in_use, scene, minute);
    }

  private:
    void look_at_tip(std::size_t finger, const RoundCone& tip, bool in_use, const Scene& scene,
                     Minute& minute) {
        const float gap = gap_m(scene, tip.a, tip.radius_a);
        const bool down = in_use && gap <= 0.001F;
        if (down) {
            if (finger == 0 && frames_[0] > 0) minute.dragged_m += (tip.a - before_).norm();
            ++frames_[finger];
        } else if (frames_[finger] > 0) {
            ++(finger == 0 ? minute.contacts : minute.thumb_contacts);
            minute.short_contacts += finger == 0 && frames_[0] == 1;
            minute.longest_frames = std::max(minute.longest_frames, frames_[finger]);
            frames_[finger] = 0;
        }
        if (frames_[finger] > 1 && down)
            minute.worst_contact_m = std::max(minute.worst_contact_m, std::abs(gap) * still(tip));
        if (finger == 0) before_ = tip.a;
    }

    /// 1 where the index has not moved since the last frame, else 0.
    float still(const RoundCone& tip) const { return (tip.a - before_).norm() < 1e-6F ? 1.0F : 0.0F; }

    int frames_[2] = {0, 0};
    Vec3 before_ = Vec3::Zero();
};

Minute play_minute(HandScript script, const Scene& scene, float half) {
    Minute minute;
    Contacts contacts;
    Vec3 before = Vec3::Zero();
    bool was_here = false;
    for (int frame = 0; frame < 1800; ++frame) {
        for (int quarter = 0; quarter < 4; ++quarter) {
            const auto moment = script.at((frame + 0.25 * quarter) / 30.0);
            if (moment) {
                look_at_parts(moment->hand, scene, half, minute);
                const Vec3 tip = moment->hand.index().a;
                if (was_here)
                    minute.highest_speed_m_s =
                        std::max(minute.highest_speed_m_s, 120.0F * (tip - before).norm());
                before = tip;
                if (quarter == 0) contacts.look(*moment, scene, minute);
            }
            was_here = moment.has_value();
        }
    }
    return minute;
}

class EveryScene : public testing::TestWithParam<std::tuple<SimulatedScene, int>> {};

TEST_P(EveryScene, HandsTouchOftenStayOutOfTheSceneAndApart) {
    const auto [scene, seed] = GetParam();
    const Table table(config_of(scene, static_cast<std::uint64_t>(seed)));
    Minute all;
    for (const float half : {-1.0F, 1.0F}) {
        const Minute minute = play_minute(table.script(half < 0.0F ? 0 : 1, half), table.scene, half);
        EXPECT_LT(minute.deepest_m, 0.001F);
        EXPECT_FALSE(minute.crossed) << "each hand keeps to its half, so that they cannot meet";
        EXPECT_LT(minute.highest_speed_m_s, 2.5F);
        EXPECT_LT(minute.worst_contact_m, 0.0003F);
        all.contacts += minute.contacts;
        all.short_contacts += minute.short_contacts;
        all.thumb_contacts += minute.thumb_contacts;
        all.dragged_m += minute.dragged_m;
        all.longest_frames = std::max(all.longest_frames, minute.longest_frames);
    }
    EXPECT_GE(all.contacts, 40);
    EXPECT_GE(all.thumb_contacts, 1);
    EXPECT_GE(all.longest_frames, 15) << "some are held";
    EXPECT_GE(all.dragged_m, 0.3F);
}

INSTANTIATE_TEST_SUITE_P(Simulator, EveryScene,
                         testing::Combine(testing::Values(SimulatedScene::flat, SimulatedScene::curved,
                                                          SimulatedScene::cluttered, SimulatedScene::bowl,
                                                          SimulatedScene::mixed),
                                          testing::Values(1, 2)));

TEST(HandScript, TapsAreAsShortAsThoseOfPeople) {
    int short_contacts = 0;
    int contacts = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const Table table(config_of(SimulatedScene::flat, seed));
        const Minute minute = play_minute(table.script(0, -1.0F), table.scene, -1.0F);
        short_contacts += minute.short_contacts;
        contacts += minute.contacts;
    }
    EXPECT_GE(short_contacts, 4) << "of " << contacts;
    EXPECT_LE(short_contacts, contacts / 4);
}

TEST(HandScript, SlowTimingGivesNoContactOfOneFrame) {
    SimulatorConfig config = config_of(SimulatedScene::flat, 3);
    config.human_timing = false;
    const Table table(config);
    EXPECT_EQ(play_minute(table.script(0, -1.0F), table.scene, -1.0F).short_contacts, 0);
}

/// The index's distances from the scene in a minute, metres, 30 a second.
std::vector<float> gaps_of_a_minute(const Table& table) {
    HandScript script = table.script(0, -1.0F);
    std::vector<float> gaps_m;
    for (int frame = 0; frame < 1800; ++frame) {
        const auto moment = script.at(frame / 30.0);
        if (!moment) continue;
        const RoundCone& tip = moment->hand.index();
        gaps_m.push_back(gap_m(table.scene, tip.a, tip.radius_a));
    }
    return gaps_m;
}

TEST(HandScript, HandsThatOnlyHoverNeverTouch) {
    // Seed 10 has a way over a box that would pass it by 7 mm.
    for (const SimulatedScene scene : {SimulatedScene::flat, SimulatedScene::cluttered}) {
        SimulatorConfig config = config_of(scene, 10);
        config.gestures = Gestures::hover;
        const std::vector<float> gaps_m = gaps_of_a_minute(Table(config));
        ASSERT_GT(gaps_m.size(), 900U);
        EXPECT_GE(*std::min_element(gaps_m.begin(), gaps_m.end()), 0.0149F);
        const auto low = std::count_if(gaps_m.begin(), gaps_m.end(), [](float gap) { return gap < 0.06F; });
        EXPECT_GT(low, 60) << "some are near enough to be mistaken";
    }
}

TEST(HandScript, HandsThatHoverLowAreAtEveryMillimetre) {
    SimulatorConfig config = config_of(SimulatedScene::flat, 5);
    config.gestures = Gestures::low;
    const std::vector<float> gaps_m = gaps_of_a_minute(Table(config));
    EXPECT_GE(*std::min_element(gaps_m.begin(), gaps_m.end()), 0.0019F);
    const auto frames_in = [&](float least_m, float most_m) {
        return std::count_if(gaps_m.begin(), gaps_m.end(),
                             [&](float gap) { return gap >= least_m && gap < most_m; });
    };
    EXPECT_GE(frames_in(0.002F, 0.008F), 60);
    EXPECT_GE(frames_in(0.008F, 0.014F), 60);
}

TEST(HandScript, ASleeveChangesNothingButTheArm) {
    SimulatorConfig config = config_of(SimulatedScene::flat, 2);
    const Table loose(config);
    config.sleeve = Sleeve::tight;
    const Table tight(config);
    const auto hand_of = [](const Table& table) { return table.script(0, 0.0F).at(5.0)->hand; };
    const Hand a = hand_of(loose), b = hand_of(tight);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    int sleeves = 0;
    for (std::size_t i = 0; i < a.parts.size(); ++i) {
        const bool sleeve = a.parts[i].material == HandMaterial::sleeve;
        const float narrower = a.parts[i].cone.radius_a - b.parts[i].cone.radius_a;
        EXPECT_NEAR(narrower, sleeve ? 0.007F : 0.0F, 0.0007F) << "part " << i;
        sleeves += sleeve ? 1 : 0;
    }
    EXPECT_GE(sleeves, 2);
}

TEST(HandScript, DrawnSleevesAreOfBothKinds) {
    SimulatorConfig config = config_of(SimulatedScene::flat, 1);
    config.sleeve = Sleeve::drawn;
    int tight = 0, loose = 0;
    for (config.seed = 1; config.seed <= 12; ++config.seed) {
        const float sleeve_mm = Table(config).script(0, 0.0F).shape().sleeve_mm;
        tight += sleeve_mm == 1.0F ? 1 : 0;
        loose += sleeve_mm >= 6.0F && sleeve_mm <= 12.0F ? 1 : 0;
    }
    EXPECT_EQ(tight + loose, 12);
    EXPECT_GE(std::min(tight, loose), 2);
}

TEST(HandScript, NobodyIsThereAtTheStart) {
    const Table table(config_of(SimulatedScene::mixed, 1));
    HandScript script = table.script(0, 0.0F);
    for (int frame = 0; frame < 75; ++frame) EXPECT_FALSE(script.at(frame / 30.0));
    bool came = false;
    for (int frame = 75; frame < 150; ++frame) came = came || script.at(frame / 30.0);
    EXPECT_TRUE(came);
}

/// Ten minutes: with pauses of 20 s on average they are there for less than half of the time, and still come.
TEST(HandScript, VisitorsStayAwayForAsLongAsIsAsked) {
    const auto here_s = [](double pause_s) {
        SimulatorConfig config = config_of(SimulatedScene::flat, 3);
        config.pause_s = pause_s;
        const Table table(config);
        HandScript script = table.script(0, 0.0F);
        int seconds = 0;
        for (int second = 0; second < 600; ++second) seconds += script.at(second).has_value();
        return seconds;
    };
    EXPECT_GT(here_s(0.0), 450);
    const int visited_s = here_s(20.0);
    EXPECT_LT(visited_s, 400);
    EXPECT_GT(visited_s, 120);
}

TEST(HandScript, HandsComeFromOutsideThePicture) {
    const Table table(config_of(SimulatedScene::flat, 2));
    HandScript script = table.script(0, 0.0F);
    bool was_here = false;
    int entries = 0;
    for (int step = 0; step < 9000; ++step) {
        const auto moment = script.at(step / 150.0);
        if (moment && !was_here) {
            ++entries;
            const Vec3 tip_c = table.view.to_camera(moment->hand.index().a);
            const Eigen::Vector2f pixel = table.view.project(tip_c);
            EXPECT_FALSE(pixel.x() > 0 && pixel.x() < 640 && pixel.y() > 0 && pixel.y() < 480)
                << pixel.transpose();
        }
        was_here = moment.has_value();
    }
    EXPECT_GE(entries, 2);
}

TEST(HandScript, TheFrameTimesDoNotChangeTheMovement) {
    const Table table(config_of(SimulatedScene::flat, 4));
    HandScript slow = table.script(0, 0.0F);
    HandScript fast = table.script(0, 0.0F);
    for (int step = 0; step <= 1200; ++step) {
        const auto moment = fast.at(step / 120.0);
        if (step % 4 != 0) continue;
        const auto same = slow.at(step / 120.0);
        ASSERT_EQ(moment.has_value(), same.has_value());
        if (moment) {
            EXPECT_EQ(moment->hand.index().a, same->hand.index().a);
        }
    }
}

}  // namespace
}  // namespace touchstone::sim
