#include "tests/accuracy/baselines/direct_fingers.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/accuracy/baselines/made_up_picture.hpp"

namespace touchstone::baselines {
namespace {

/// Zones of a made-up arm from the left with a hand and a finger that points right; 0 mm around it.
struct MadeUpArm {
    int arm_px = 20, hand_px = 8, finger_px = 12;

    Zones zones() const {
        Zones made{Raster<Zone>(64, 48, Zone::noise), Raster<float>(64, 48, 0.0F)};
        const auto add = [&](int left_px, int long_px, Zone zone, float mm) {
            fill(made.zone, {left_px, 20, long_px, 6}, zone);
            fill(made.height_mm, {left_px, 20, long_px, 6}, mm);
        };
        add(0, arm_px, Zone::high, 80.0F);
        add(20, hand_px, Zone::mid, 30.0F);
        add(28, finger_px, Zone::low, 6.0F);
        return made;
    }
};

TEST(DirectFingers, AFingerEndsFarFromTheHand) {
    const auto fingers = find_fingers(MadeUpArm{}.zones(), {});
    ASSERT_EQ(fingers.size(), 1U);
    EXPECT_EQ(fingers.front().tip_px.x(), 39.0);
    EXPECT_NEAR(fingers.front().tip_px.y(), 22.5, 2.5);
    EXPECT_FLOAT_EQ(fingers.front().height_mm, 0.0F) << "the flood reaches the surface before it";
}

TEST(DirectFingers, WithoutNoiseAroundItTheTipIsTheFingers) {
    Zones zones = MadeUpArm{}.zones();
    std::replace(zones.zone.values.begin(), zones.zone.values.end(), Zone::noise, Zone::unknown);
    const auto fingers = find_fingers(zones, {});
    ASSERT_EQ(fingers.size(), 1U);
    EXPECT_FLOAT_EQ(fingers.front().height_mm, 6.0F);
}

TEST(DirectFingers, NeedAHandAndAnArm) {
    EXPECT_TRUE(find_fingers(MadeUpArm{.arm_px = 0}.zones(), {}).empty());
    EXPECT_TRUE(find_fingers(MadeUpArm{.hand_px = 7}.zones(), {}).empty()) << "a gap of one pixel";
    EXPECT_TRUE(find_fingers(MadeUpArm{.finger_px = 0}.zones(), {}).empty());
}

TEST(DirectFingers, AStumpIsNone) {
    const auto count = [](int finger_px) {
        Zones zones = MadeUpArm{.finger_px = finger_px}.zones();
        std::replace(zones.zone.values.begin(), zones.zone.values.end(), Zone::noise, Zone::unknown);
        return find_fingers(zones, {}).size();
    };
    EXPECT_EQ(count(4), 0U);
    EXPECT_EQ(count(6), 1U);
}

}  // namespace
}  // namespace touchstone::baselines
