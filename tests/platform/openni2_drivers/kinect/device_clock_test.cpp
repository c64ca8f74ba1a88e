#include "platform/openni2_drivers/kinect/device_clock.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

constexpr std::uint64_t wrap_us = (std::uint64_t{1} << 32) / 60;
constexpr std::uint32_t frame_ticks = 2'002'155;

TEST(DeviceClock, TicksAreSixtiethsOfAMicrosecond) {
    DeviceClock clock;
    EXPECT_EQ(clock.time_us(6'000'000, 5), 100'000U);
    EXPECT_EQ(clock.time_us(6'000'000 + frame_ticks, 33'374), (6'000'000U + frame_ticks) / 60);
}

TEST(DeviceClock, GoesOnOverManyWraps) {
    DeviceClock clock;
    std::uint64_t ticks = 4'000'000'000;
    std::uint64_t host_us = 1'000'000;
    for (int frame = 0; frame < 10'000; ++frame) {
        const std::uint64_t late_us = static_cast<std::uint64_t>(frame) * 7919 % 20'000;
        ASSERT_EQ(clock.time_us(static_cast<std::uint32_t>(ticks), host_us + late_us), ticks / 60)
            << "frame " << frame;
        ticks += frame_ticks;
        host_us += frame_ticks / 60;
    }
    EXPECT_GT(ticks / 60, 4 * wrap_us);
}

TEST(DeviceClock, CountsTheWrapsOfALongPause) {
    DeviceClock clock;
    const std::uint64_t first = clock.time_us(1000, 0);
    const std::uint64_t pause_us = 3 * wrap_us + 40'000'000;
    const auto ticks = static_cast<std::uint32_t>(1000 + pause_us * 60);
    EXPECT_NEAR(static_cast<double>(clock.time_us(ticks, pause_us + 300'000) - first),
                static_cast<double>(pause_us), 2);
}

TEST(DeviceClock, DepthAndColourMayComeOutOfOrder) {
    DeviceClock clock;
    clock.time_us(60'000'000, 0);
    EXPECT_EQ(clock.time_us(59'400'000, 1000), 990'000U);
    EXPECT_EQ(clock.time_us(60'600'000, 10'000), 1'010'000U);
}

TEST(DeviceClock, AClockThatBeginsAnewGoesOnByTheHostsTime) {
    DeviceClock clock;
    clock.time_us(3'000'000'000, 1'000'000);
    EXPECT_EQ(clock.time_us(120, 1'500'000), 50'500'000U);
    EXPECT_EQ(clock.time_us(120 + frame_ticks, 1'533'369), 50'500'000U + frame_ticks / 60);
}

}  // namespace
}  // namespace touchstone
