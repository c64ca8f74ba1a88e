#include "app/command_line.hpp"

#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

Command parse(std::vector<const char*> words) {
    words.insert(words.begin(), "touchstone");
    return parse_command_line(static_cast<int>(words.size()), words.data());
}

TEST(CommandLine, NoSubCommandMeansRun) {
    const RunOptions plain = std::get<RunOptions>(parse({"--frames", "7", "--display", "headless"}));
    const RunOptions named = std::get<RunOptions>(parse({"run", "--frames", "7", "--display", "headless"}));
    EXPECT_EQ(plain.frames, 7);
    EXPECT_EQ(named.frames, 7);
    EXPECT_EQ(plain.display, DisplayKind::headless);
    EXPECT_FALSE(std::get<RunOptions>(parse({})).frames.has_value());
}

TEST(CommandLine, EveryOptionOfTheContract) {
    const RunOptions options =
        std::get<RunOptions>(parse({"run", "--sensor", "seq:/data", "--pace", "live", "--scene", "paint",
                                    "--events", "-", "--maps", "m", "--shots", "s"}));
    EXPECT_EQ(options.config.sensor_uri, "seq:/data");
    EXPECT_EQ(options.pace, Pace::live);
    EXPECT_EQ(options.config.display.scene, "paint");
    EXPECT_EQ(options.events_file, "-");
    EXPECT_EQ(options.maps_dir, "m");
    EXPECT_EQ(options.shots_dir, "s");
}

TEST(CommandLine, PrintConfigAndHelpAreTextsForStandardOutput) {
    EXPECT_THAT(std::get<PrintedText>(parse({"run", "--print-config"})).text,
                testing::HasSubstr("[scan]\nframes = 20"));
    EXPECT_THAT(std::get<PrintedText>(parse({"--help"})).text, testing::HasSubstr("--sensor"));
    EXPECT_FALSE(std::get<PrintedText>(parse({"--version"})).text.empty());
}

TEST(CommandLine, WhatIsNotUnderstoodIsAUsageError) {
    for (const auto& words : std::vector<std::vector<const char*>>{{"--nonsense"},
                                                                   {"run", "--pace", "fast"},
                                                                   {"run", "--frames", "0"},
                                                                   {"run", "--frames", "many"},
                                                                   {"run", "--scene", "nowhere"},
                                                                   {"dance"}}) {
        expect_error([&] { (void)parse(words); }, ExitStatus::usage, testing::HasSubstr("--help"));
    }
}

}  // namespace
}  // namespace touchstone
