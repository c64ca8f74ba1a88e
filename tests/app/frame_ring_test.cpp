#include "app/frame_ring.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

constexpr double ten_s = 10.0;
constexpr std::size_t plenty_bytes = 40'000'000;

DepthFrame numbered_frame(int index, int width_px = 32, int height_px = 24) {
    DepthFrame frame{index, static_cast<std::uint64_t>(index) * 100'000, width_px, height_px, {}, {}, {}};
    frame.intrinsics = {30, 31, 16, 12, width_px, height_px, {}};
    for (int i = 0; i < width_px * height_px; ++i)
        frame.depth_mm.push_back(static_cast<std::uint16_t>(i % 7 == 0 ? 0 : index * 7919 + i * i * 31));
    return frame;
}

TEST(FrameRing, GivesBackEveryPixel) {
    FrameRing ring(ten_s, plenty_bytes);
    for (int index = 5; index < 25; ++index) ring.add(numbered_frame(index));
    ASSERT_EQ(ring.frames(), 20u);
    EXPECT_EQ(ring.intrinsics().fy_px, 31.0f);
    for (std::size_t i = 0; i < 20; ++i) {
        const DepthFrame expected = numbered_frame(5 + static_cast<int>(i)), frame = ring.frame(i);
        EXPECT_EQ(frame.index, expected.index);
        EXPECT_EQ(frame.timestamp_us, expected.timestamp_us);
        EXPECT_EQ(frame.width_px, 32);
        EXPECT_EQ(frame.height_px, 24);
        EXPECT_EQ(frame.depth_mm, expected.depth_mm) << i;
    }
    EXPECT_THROW(ring.frame(20), std::out_of_range);
}

TEST(FrameRing, TheExtremesOfSixteenBitsComeBack) {
    FrameRing ring(ten_s, plenty_bytes);
    DepthFrame frame = numbered_frame(0, 4, 1);
    frame.depth_mm = {0, 255, 256, 65535};
    ring.add(frame);
    EXPECT_EQ(ring.frame(0).depth_mm, frame.depth_mm);
}

TEST(FrameRing, KeepsTenSeconds) {
    FrameRing ring(ten_s, plenty_bytes);
    for (int index = 0; index < 250; ++index) ring.add(numbered_frame(index));
    ASSERT_EQ(ring.frames(), 101u) << "ten a second, both ends";
    EXPECT_EQ(ring.frame(0).index, 149);
    EXPECT_EQ(ring.frame(100).index, 249);
}

TEST(FrameRing, KeepsToItsMemory) {
    FrameRing ring(ten_s, 20'000);
    for (int index = 0; index < 100; ++index) {
        ring.add(numbered_frame(index));
        EXPECT_LE(ring.bytes(), 20'000u);
    }
    EXPECT_GT(ring.frames(), 5u);
    EXPECT_EQ(ring.frame(ring.frames() - 1).depth_mm, numbered_frame(99).depth_mm);
    FrameRing tiny(ten_s, 10);
    tiny.add(numbered_frame(0));
    EXPECT_EQ(tiny.frames(), 0u);
    EXPECT_EQ(tiny.bytes(), 0u);
}

TEST(FrameRing, AnotherCameraOrOneOpenedAgainBeginsAnew) {
    FrameRing ring(ten_s, plenty_bytes);
    ring.add(numbered_frame(7));
    ring.add(numbered_frame(8));
    ring.add(numbered_frame(0));
    EXPECT_EQ(ring.frames(), 1u) << "numbers and times begin again";
    ring.add(numbered_frame(1, 16, 12));
    ASSERT_EQ(ring.frames(), 1u) << "another size";
    EXPECT_EQ(ring.frame(0).depth_mm, numbered_frame(1, 16, 12).depth_mm);
    ring.clear();
    EXPECT_EQ(ring.frames(), 0u);
    EXPECT_EQ(ring.bytes(), 0u);
}

}  // namespace
}  // namespace touchstone
