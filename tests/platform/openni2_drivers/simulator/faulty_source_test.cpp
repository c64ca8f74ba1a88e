#include "platform/openni2_drivers/simulator/faulty_source.hpp"

#include <gtest/gtest.h>
#include <optional>
#include <set>

#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

/// Ten frames a second, of four pixels that are their frame's number.
class Counter : public FrameSource {
  public:
    const SourceInfo& info() const override { return info_; }
    void enable_color(bool) override {}
    bool next(SourceFrame& frame) override {
        frame.index = next_++;
        frame.timestamp_us = static_cast<std::uint64_t>(frame.index) * 100'000;
        frame.depth_mm.assign(4, static_cast<std::uint16_t>(frame.index));
        return true;
    }

  private:
    SourceInfo info_;
    int next_ = 0;
};

struct Faulty {
    explicit Faulty(const SimulatorFaults& faults) : source(std::make_unique<Counter>(), faults) {}
    SourceFrame next() {
        SourceFrame frame;
        EXPECT_TRUE(source.next(frame));
        return frame;
    }
    FaultySource source;
};

TEST(FaultySource, StallsForItsTimeOrUntilRestarted) {
    SimulatorFaults faults;
    faults.stall_s = 0.3;
    faults.fault_s = 0.4;
    Faulty lasting(faults), healed(faults);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(lasting.next().withheld, i >= 3 && i < 7) << i;
    for (int i = 0; i < 5; ++i) healed.next();
    healed.source.restarted();
    for (int i = 5; i < 10; ++i) EXPECT_FALSE(healed.next().withheld) << i;
}

TEST(FaultySource, ARestartBeforeTheFaultDoesNotPreventIt) {
    SimulatorFaults faults;
    faults.stall_s = 0.2;
    Faulty faulty(faults);
    faulty.next();
    faulty.source.restarted();
    faulty.next();
    EXPECT_TRUE(faulty.next().withheld);
}

/// Unlike from one opening to the next, alike for the same.
TEST(FaultySource, FaultsAreDrawnFromSeedAndOpening) {
    SimulatorFaults faults;
    faults.every_s = 1.0;
    faults.fault_s = 0.3;
    const auto kinds = [&](std::uint64_t opening) {
        FaultySource source(std::make_unique<Counter>(), faults, sim::Random(5, opening));
        std::string found;
        std::uint16_t last = 0;
        for (int i = 0; i < 100; ++i) {
            SourceFrame frame;
            EXPECT_TRUE(source.next(frame));
            if (frame.back_after_s) return found + "u";
            found += frame.withheld                        ? 's'
                     : frame.depth_mm[0] == last           ? 'f'
                     : frame.timestamp_us >= 3'600'000'000 ? 'c'
                                                           : '.';
            last = frame.depth_mm[0];
        }
        return found;
    };
    std::set<std::string> all;
    std::string seen;
    for (std::uint64_t opening = 0; opening < 8; ++opening) {
        EXPECT_EQ(kinds(opening), kinds(opening));
        all.insert(kinds(opening));
        seen += kinds(opening);
    }
    EXPECT_GT(all.size(), 6U);
    for (const char kind : {'u', 's', 'f', 'c', '.'}) EXPECT_NE(seen.find(kind), std::string::npos) << kind;
}

TEST(FaultySource, FreezesThePictureWhileTimeGoesOn) {
    SimulatorFaults faults;
    faults.freeze_s = 0.2;
    faults.fault_s = 0.3;
    Faulty faulty(faults);
    for (int i = 0; i < 8; ++i) {
        const SourceFrame frame = faulty.next();
        EXPECT_EQ(frame.index, i);
        EXPECT_EQ(frame.depth_mm[0], i >= 2 && i < 5 ? 1 : i);
    }
}

TEST(FaultySource, TearsOnePicture) {
    SimulatorFaults faults;
    faults.tear_s = 0.2;
    Faulty faulty(faults);
    for (int i = 0; i < 5; ++i) {
        const auto upper = static_cast<std::uint16_t>(i), lower = static_cast<std::uint16_t>(i == 2 ? 1 : i);
        EXPECT_EQ(faulty.next().depth_mm, (std::vector<std::uint16_t>{upper, upper, lower, lower}));
    }
}

TEST(FaultySource, TearsOneInSoManySeconds) {
    SimulatorFaults faults;
    faults.tear_s = 0.2;
    faults.tear_every_s = 0.3;
    Faulty faulty(faults);
    for (int i = 0; i < 9; ++i) {
        const bool torn = i == 2 || i == 5 || i == 8;
        EXPECT_EQ(faulty.next().depth_mm[2], torn ? i - 1 : i) << i;
    }
}

TEST(FaultySource, ClockJumpsByAnHour) {
    SimulatorFaults faults;
    faults.clock_jump_s = 0.1;
    Faulty faulty(faults);
    EXPECT_EQ(faulty.next().timestamp_us, 0U);
    EXPECT_EQ(faulty.next().timestamp_us, 3'600'100'000U);
}

TEST(FaultySource, IsPulledOut) {
    SimulatorFaults faults;
    faults.unplug_s = 0.1;
    faults.fault_s = 1.5;
    Faulty faulty(faults);
    EXPECT_FALSE(faulty.next().back_after_s);
    EXPECT_EQ(faulty.next().back_after_s, 1.5);
}

TEST(FaultySource, KeysOfTheUri) {
    const SimulatorConfig config = parse_simulator_uri(
        "flat?unplug_at=1&stall_at=2&freeze_at=3&tear=4&tear_every=6&clock_jump=5&fault_s=0");
    EXPECT_EQ(config.faults.unplug_s, 1);
    EXPECT_EQ(config.faults.stall_s, 2);
    EXPECT_EQ(config.faults.freeze_s, 3);
    EXPECT_EQ(config.faults.tear_s, 4);
    EXPECT_EQ(config.faults.tear_every_s, 6);
    EXPECT_EQ(config.faults.clock_jump_s, 5);
    EXPECT_EQ(config.faults.fault_s, 0);
    EXPECT_FALSE(parse_simulator_uri("flat").faults.any());
    expect_error([] { parse_simulator_uri("flat?stall_at=-1"); }, ExitStatus::usage,
                 ::testing::HasSubstr("stall_at"));
}

}  // namespace
}  // namespace touchstone
