#include "platform/openni2_drivers/kinect/zero_plane.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

namespace touchstone {
namespace {

TEST(ZeroPlane, SpotValuesOfTheNominalPlane) {
    const ZeroPlane plane;
    EXPECT_EQ(raw_to_mm(400, plane), 501);
    EXPECT_EQ(raw_to_mm(600, plane), 706);
    EXPECT_EQ(raw_to_mm(800, plane), 1194);
    EXPECT_EQ(raw_to_mm(900, plane), 1824);
    EXPECT_EQ(raw_to_mm(1000, plane), 3864);
}

TEST(ZeroPlane, InvalidBeyondTenMetresAndBeyondInfinityAreZero) {
    const ZeroPlane plane;
    EXPECT_EQ(raw_to_mm(2047, plane), 0);
    EXPECT_EQ(raw_to_mm(2048, plane), 0);
    EXPECT_EQ(raw_to_mm(65535, plane), 0);
    EXPECT_EQ(raw_to_mm(1200, plane), 0);
    std::uint16_t before = 0;
    for (std::uint16_t raw = 0; raw < raw_depth_values; ++raw) {
        const std::uint16_t mm = raw_to_mm(raw, plane);
        EXPECT_LE(mm, farthest_depth_mm);
        if (mm == 0) continue;
        EXPECT_GE(mm, before) << "farther with every step, raw " << raw;
        before = mm;
    }
    EXPECT_GT(before, 9000);
}

TEST(ZeroPlane, ADeviceMayHaveItsOwn) {
    ZeroPlane plane;
    plane.constant_shift = 190;
    EXPECT_EQ(raw_to_mm(760, plane), raw_to_mm(800, ZeroPlane{}));
    plane.distance_mm = 60;
    EXPECT_NEAR(raw_to_mm(760, plane), raw_to_mm(800, ZeroPlane{}) / 2, 1);
}

TEST(ZeroPlane, SameMillimetresAsTheTableOfTheRecording) {
    std::ifstream file(std::string(TOUCHSTONE_SHARED_DIR) + "/data/kinect-room-person/raw_to_mm.txt");
    if (!file) GTEST_SKIP() << "no recording beside the checkout";
    const DepthTable table = depth_table({});
    std::string line;
    std::size_t compared = 0;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::size_t raw = 0;
        int mm = 0;
        if (!(words >> raw >> mm)) continue;
        ASSERT_LT(raw, table.size());
        EXPECT_EQ(table[raw], mm) << "raw " << raw;
        ++compared;
    }
    EXPECT_EQ(compared, raw_depth_values);
}

TEST(ZeroPlane, FocalLengthIsThePlanesDistanceInPixels) {
    const Intrinsics nominal = depth_intrinsics({});
    EXPECT_NEAR(nominal.fx_px, 575.816F, 1e-3F);
    EXPECT_EQ(nominal.fy_px, nominal.fx_px);
    EXPECT_EQ(nominal.cx_px, 319.5F);
    EXPECT_EQ(nominal.cy_px, 239.5F);
}

}  // namespace
}  // namespace touchstone
