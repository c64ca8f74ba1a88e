#include "platform/openni2_drivers/sequence/camera_intrinsics.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

TEST(CameraIntrinsics, ReadsAMatrix) {
    const TemporaryFolder folder;
    std::ofstream(folder / "k.txt") << "5.85e+02 0 3.2e+02\n0 586 241\n0 0 1\n";
    const Intrinsics k = read_intrinsics(folder / "k.txt", 640, 480);
    EXPECT_FLOAT_EQ(k.fx_px, 585);
    EXPECT_FLOAT_EQ(k.fy_px, 586);
    EXPECT_FLOAT_EQ(k.cx_px, 320);
    EXPECT_FLOAT_EQ(k.cy_px, 241);
    EXPECT_EQ(k.width_px, 640);
    EXPECT_EQ(k.height_px, 480);
}

TEST(CameraIntrinsics, AnythingElseIsBadDataAndNamed) {
    const TemporaryFolder folder;
    for (const char* text :
         {"", "585 0 320 0 585 240 0 0", "585 0 320 0 585 240 0 0 2", "585 0 320 0 -585 240 0 0 1",
          "585 0 320 0 585 240 0 0 1 7", "585 0 320 0 0 240 0 0 1", "a b c", "585 0.1 320 0 585 240 0 0 1",
          "nan 0 320 0 585 240 0 0 1", "inf 0 320 0 585 240 0 0 1"}) {
        std::ofstream(folder / "k.txt") << text;
        SCOPED_TRACE(text);
        expect_error([&] { read_intrinsics(folder / "k.txt", 640, 480); }, ExitStatus::bad_data,
                     ::testing::HasSubstr("k.txt"));
    }
}

TEST(CameraIntrinsics, TheDefaultIsTheKinectScaledWithThePicture) {
    const Intrinsics full = default_intrinsics(640, 480);
    EXPECT_FLOAT_EQ(full.fx_px, 575.8F);
    EXPECT_FLOAT_EQ(full.fy_px, 575.8F);
    EXPECT_FLOAT_EQ(full.cx_px, 319.5F);
    EXPECT_FLOAT_EQ(full.cy_px, 239.5F);
    const Intrinsics half = default_intrinsics(320, 240);
    EXPECT_FLOAT_EQ(half.fx_px, 287.9F);
    EXPECT_FLOAT_EQ(half.cx_px, 159.5F);
    EXPECT_FLOAT_EQ(half.cy_px, 119.5F);
}

}  // namespace
}  // namespace touchstone
