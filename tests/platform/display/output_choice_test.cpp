#include "platform/display/output_choice.hpp"

#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

const std::vector<Output> three{
    {"eDP-1", {{1920, 1200}, 60}, {{{1920, 1200}, 60}}},
    {"HDMI-A-1 EPSON PJ", {{1280, 800}, 60}, {{{1920, 1080}, 60}, {{1280, 800}, 60}, {{1280, 800}, 75}}},
    {"DP-1", {{1024, 768}, 0}, {}}};

std::string chosen(const char* wanted) { return choose_output(three, wanted).name; }

TEST(OutputChoice, ByNameByPartOfItElseTheLast) {
    EXPECT_EQ(chosen("HDMI-A-1"), "HDMI-A-1 EPSON PJ");
    EXPECT_EQ(chosen("epson"), "HDMI-A-1 EPSON PJ");
    EXPECT_EQ(chosen("DP-1"), "DP-1") << "a whole name goes before eDP-1, which has it in it";
    EXPECT_EQ(chosen("edp"), "eDP-1");
    EXPECT_EQ(chosen(""), "DP-1");
    EXPECT_EQ(find_output(std::span(three).first(1), ""), 0U) << "the only one";
}

TEST(OutputChoice, AWrongNameSaysWhichThereAre) {
    expect_error([] { (void)choose_output(three, "VGA"); }, ExitStatus::unavailable,
                 testing::AllOf(testing::HasSubstr("\"VGA\""), testing::HasSubstr("eDP-1 (1920x1200@60), "),
                                testing::HasSubstr("HDMI-A-1 EPSON PJ (1280x800@60; 1920x1080@60, "
                                                   "1280x800@75), DP-1 (1024x768)")));
    expect_error([] { (void)choose_output({}, ""); }, ExitStatus::unavailable,
                 testing::HasSubstr("no screen or projector"));
}

TEST(OutputChoice, ModesByText) {
    const Output& projector = three[1];
    EXPECT_EQ(choose_mode(projector, ""), (ScreenMode{{1280, 800}, 60}));
    EXPECT_EQ(choose_mode(projector, "1920x1080@60"), (ScreenMode{{1920, 1080}, 60}));
    EXPECT_EQ(choose_mode(projector, "1280x800"), (ScreenMode{{1280, 800}, 75})) << "its fastest";
    for (const char* wanted : {"1280x800@50", "640x480"})
        expect_error([&] { (void)choose_mode(projector, wanted); }, ExitStatus::configuration,
                     testing::AllOf(testing::HasSubstr(wanted), testing::HasSubstr("1280x800@75")));
    expect_error([&] { (void)choose_mode(projector, "wide"); }, ExitStatus::configuration,
                 testing::HasSubstr("e.g. 1280x800@60"));
}

TEST(OutputChoice, TextsOfModes) {
    for (const char* text : {"1280x800@60", "640x480"}) EXPECT_EQ(to_text(*parse_screen_mode(text)), text);
    for (const char* text : {"", "1280", "1280x", "x800", "1280x800@", "1280x800@60Hz", "0x800", "-1x800",
                             "1280 x 800", "99999x1", "1280x800@1001"})
        EXPECT_FALSE(parse_screen_mode(text)) << text;
}

}  // namespace
}  // namespace touchstone
