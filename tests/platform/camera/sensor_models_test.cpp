#include "platform/camera/sensor_models.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "platform/camera/openni_frame.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* laser = R"([[sensor]]
name = "Laser"
usb = ["1234:abcd", "045e:02ae"]
mode = "512x424@30"
noise = { constant_m = 0.002, quadratic = 0, offset_m = 0.0, grazing = 0.0 }
intrinsics = [{ width_px = 512, height_px = 424, fx_px = 365.5, fy_px = 365, cx_px = 255.5, cy_px = 211 }]
)";

/// The text with one line put in place of another, refused with words that name file and line.
void expect_refused(const std::string& line, const std::string& instead, const std::string& where) {
    std::string text = laser;
    text.replace(text.find(line), line.size(), instead);
    expect_error([&] { parse_sensor_models(text, "my.toml"); }, ExitStatus::configuration, HasSubstr(where));
}

TEST(DepthMode, IsReadAsItIsWritten) {
    EXPECT_EQ(parse_depth_mode("320x240@60"), (DepthMode{320, 240, 60}));
    EXPECT_EQ(to_text({320, 240, 60}), "320x240@60");
    for (const char* text : {"", "320x240", "320@60", "x240@60", "320x240@", "320x240@60Hz", "-320x240@60",
                             "8x8@30", "320x240@0", " 320x240@60", "99999999999x240@60"})
        EXPECT_FALSE(parse_depth_mode(text)) << text;
}

TEST(NearestMode, SizeCountsFirstThenTheRate) {
    const std::vector<DepthMode> modes{
        {320, 240, 60}, {640, 480, 25}, {640, 480, 30}, {1280, 1024, 30}, {320, 240, 30}};
    EXPECT_EQ(nearest_mode(modes, {640, 480, 30}), 2U);
    EXPECT_EQ(nearest_mode(modes, {320, 240, 60}), 0U);
    EXPECT_EQ(nearest_mode(modes, {320, 240, 25}), 4U);
    EXPECT_EQ(nearest_mode(modes, {160, 120, 30}), 3U) << "none has the size: the largest";
    EXPECT_EQ(nearest_mode({}, {640, 480, 30}), std::nullopt);
}

TEST(SensorModels, AreFoundByTheirUsbNumbers) {
    const std::vector<SensorModel> models = load_sensor_models("");
    const SensorModel* kinect = find_sensor_model(models, 0x045e, 0x02ae);
    ASSERT_NE(kinect, nullptr);
    EXPECT_EQ(kinect->name, "Kinect v1");
    EXPECT_EQ(kinect->mode, (DepthMode{640, 480, 30}));
    EXPECT_FLOAT_EQ(kinect->noise.quadratic, 0.0019f);
    const SensorModel* xtion = find_sensor_model(models, 0x1d27, 0x0601);
    ASSERT_NE(xtion, nullptr);
    EXPECT_THAT(xtion->name, HasSubstr("Xtion"));
    EXPECT_EQ(find_sensor_model(models, 0x045e, 0x0001), nullptr);
}

TEST(SensorModels, AFileComesBeforeTheBuiltInOnes) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "my.toml") << laser;
    const std::vector<SensorModel> models = load_sensor_models((folder.path() / "my.toml").string());
    const SensorModel* kinect = find_sensor_model(models, 0x045e, 0x02ae);
    ASSERT_NE(kinect, nullptr);
    EXPECT_EQ(kinect->name, "Laser");
    EXPECT_EQ(kinect->mode, (DepthMode{512, 424, 30}));
    EXPECT_FLOAT_EQ(kinect->noise.constant_m, 0.002f);
    ASSERT_EQ(kinect->intrinsics.size(), 1U);
    EXPECT_FLOAT_EQ(kinect->intrinsics.front().fx_px, 365.5f);
    EXPECT_EQ(kinect->intrinsics.front().height_px, 424);
    EXPECT_NE(find_sensor_model(models, 0x1d27, 0x0601), nullptr);
    expect_error([&] { load_sensor_models("/nowhere/my.toml"); }, ExitStatus::no_input,
                 HasSubstr("/nowhere/my.toml"));
}

TEST(SensorModels, BadOnesAreRefusedWithTheirLine) {
    expect_refused("name = \"Laser\"\n", "", "my.toml:1: name");
    expect_refused("name = \"Laser\"", "nane = \"Laser\"", "my.toml:2: unknown key nane");
    expect_refused("usb = [\"1234:abcd\", \"045e:02ae\"]\n", "", "usb is a list");
    expect_refused("1234:abcd", "1234:abcde", "my.toml:3: usb");
    expect_refused("512x424@30", "large", "mode is WIDTHxHEIGHT@HERTZ");
    expect_refused("constant_m = 0.002, ", "", "my.toml:5: constant_m is a number from");
    expect_refused("offset_m = 0.0", "offset_m = -1.0", "offset_m is a number from 0 to 5");
    expect_refused("fx_px = 365.5", "fx_px = 0", "my.toml:6: fx_px");
    expect_refused("mode =", "mode ==", "my.toml:4:");
    expect_refused("[[sensor]]", "[[camera]]", "[[sensor]]");
}

}  // namespace
}  // namespace touchstone
