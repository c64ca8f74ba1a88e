#include "platform/openni2_drivers/kinect/registration.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

constexpr std::size_t pixels = 640 * 480;

std::size_t at(int x, int y) { return static_cast<std::size_t>(y * 640 + x); }

/// Every pixel stays where it is, moved by a whole number of pixels at every depth.
RegistrationTables moved_by(int shift_px) {
    RegistrationTables tables;
    for (int i = 0; i < 640 * 480; ++i) tables.places.push_back({i % 640 * 256, i / 640});
    tables.shifts_x.assign(10'000, shift_px * 256);
    return tables;
}

TEST(Registration, MovesByTheTables) {
    std::vector<std::uint16_t> depth(pixels, 0), out(pixels, 7);
    depth[at(100, 50)] = 1234;
    RegistrationTables tables = moved_by(-10);
    tables.first_row = 3;
    register_depth(depth, tables, out);
    EXPECT_EQ(out[at(90, 47)], 1234);
    EXPECT_EQ(std::count(out.begin(), out.end(), std::uint16_t{0}), static_cast<long>(pixels) - 1);
}

TEST(Registration, WhatLeavesThePictureIsDroppedAndDoesNotWrapToTheNextRow) {
    std::vector<std::uint16_t> depth(pixels, 0), out(pixels);
    depth[at(5, 50)] = 1234;
    depth[at(639, 479)] = 800;
    register_depth(depth, moved_by(-10), out);
    EXPECT_EQ(out[at(629, 479)], 800);
    EXPECT_EQ(std::count(out.begin(), out.end(), std::uint16_t{1234}), 0);
    register_depth(depth, moved_by(10), out);
    EXPECT_EQ(std::count(out.begin(), out.end(), std::uint16_t{800}), 0);
}

TEST(Registration, TheNearerOfTwoStays) {
    std::vector<std::uint16_t> depth(pixels, 0), out(pixels);
    RegistrationTables tables = moved_by(0);
    tables.shifts_x[900] = -256;
    depth[at(10, 4)] = 2000;
    depth[at(11, 4)] = 900;
    register_depth(depth, tables, out);
    EXPECT_EQ(out[at(10, 4)], 900);
    std::swap(depth[at(10, 4)], depth[at(11, 4)]);
    tables.shifts_x[900] = 256;
    register_depth(depth, tables, out);
    EXPECT_EQ(out[at(11, 4)], 900);
}

TEST(Registration, DepthBeyondTheTableIsDropped) {
    std::vector<std::uint16_t> depth(pixels, 10'000), out(pixels);
    register_depth(depth, moved_by(0), out);
    EXPECT_EQ(std::count(out.begin(), out.end(), std::uint16_t{0}), static_cast<long>(pixels));
}

/// A point seen at (u, v) by the infrared camera lies where the colour camera's pinhole puts it.
TEST(Registration, NominalTablesAreTwoPinholes) {
    const RegistrationTables tables = nominal_registration({});
    const Intrinsics ir = depth_intrinsics({}), color = color_intrinsics();
    for (const int mm : {500, 1200, 4000}) {
        for (const int u : {100, 320, 600}) {
            const int v = 400;
            const double x_mm = (u - double{ir.cx_px}) / double{ir.fx_px} * mm - 23.0;
            const double y_mm = (v - double{ir.cy_px}) / double{ir.fy_px} * mm;
            const double expected_x = double{color.fx_px} * x_mm / mm + double{color.cx_px};
            const double expected_y = double{color.fy_px} * y_mm / mm + double{color.cy_px};
            std::vector<std::uint16_t> depth(pixels, 0), out(pixels);
            depth[at(u, v)] = static_cast<std::uint16_t>(mm);
            register_depth(depth, tables, out);
            const auto found = std::find(out.begin(), out.end(), static_cast<std::uint16_t>(mm));
            ASSERT_NE(found, out.end());
            const auto index = static_cast<int>(found - out.begin());
            EXPECT_NEAR(index % 640, expected_x, 0.51) << u << " at " << mm;
            EXPECT_NEAR(index / 640, expected_y, 0.51);
        }
    }
}

}  // namespace
}  // namespace touchstone
