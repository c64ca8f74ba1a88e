#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/image/png_file.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

ProgramResult touchstone_run(std::vector<std::string> arguments,
                             const test::RunningProgram::Environment& environment = {}) {
    arguments.insert(arguments.begin(), {TOUCHSTONE_PROGRAM, "run", "--display", "headless"});
    return run_program(std::move(arguments), environment);
}

/// One line on standard error, past the log, that starts with the program's name.
void expect_refused(const ProgramResult& result, int status, const testing::Matcher<std::string>& message) {
    EXPECT_EQ(result.status, status) << result.err;
    std::vector<std::string> complaints;
    std::istringstream lines(result.err);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("touchstone: ")) complaints.push_back(line);
    }
    ASSERT_EQ(complaints.size(), 1u) << result.err;
    EXPECT_THAT(complaints[0], message);
}

Image16 gray_depth(int width_px, int height_px) {
    return {width_px, height_px,
            std::vector<std::uint16_t>(static_cast<std::size_t>(width_px * height_px), 1000)};
}

TEST(BadInput, MissingFolder) {
    expect_refused(touchstone_run({"--sensor", "seq:/nowhere/at/all"}), 66, HasSubstr("/nowhere/at/all"));
}

TEST(BadInput, MissingRecording) {
    expect_refused(touchstone_run({"--sensor", "/nowhere/table.oni"}), 66, HasSubstr("/nowhere/table.oni"));
}

TEST(BadInput, MissingModelOfAnObject) {
    const TemporaryFolder folder;
    std::ofstream(folder / "table.toml") << "[objects]\nmodel = \"/nowhere/toy.scan\"\n";
    expect_refused(touchstone_run({"--sensor", "sim:flat", "--config", (folder / "table.toml").string()}), 66,
                   HasSubstr("/nowhere/toy.scan"));
}

TEST(BadInput, TruncatedPng) {
    const TemporaryFolder folder;
    write_png(folder / "frame-000000.depth.png", gray_depth(64, 48));
    write_png(folder / "frame-000001.depth.png", gray_depth(64, 48));
    std::filesystem::resize_file(folder / "frame-000001.depth.png", 60);
    expect_refused(touchstone_run({"--sensor", "seq:" + folder.path().string()}), 65,
                   HasSubstr("frame-000001.depth.png"));
}

TEST(BadInput, PictureOfAnotherSize) {
    const TemporaryFolder folder;
    write_png(folder / "frame-000000.depth.png", gray_depth(64, 48));
    write_png(folder / "frame-000001.depth.png", gray_depth(32, 48));
    expect_refused(touchstone_run({"--sensor", "seq:" + folder.path().string()}), 65,
                   AllOf(HasSubstr("frame-000001.depth.png"), HasSubstr("32"), HasSubstr("64")));
}

TEST(BadInput, UnknownKeyInTheConfiguration) {
    const TemporaryFolder folder;
    std::ofstream(folder / "table.toml") << "[volume]\nsize = 512\n";
    expect_refused(touchstone_run({"--config", (folder / "table.toml").string()}), 78,
                   AllOf(HasSubstr("table.toml:2"), HasSubstr("volume.size"), HasSubstr("size_vox")));
}

TEST(BadInput, ATouchScreenThatCannotBeMade) {
    if (access("/dev/uinput", R_OK | W_OK) == 0) GTEST_SKIP() << "this machine makes touch screens";
    const TemporaryFolder folder;
    std::ofstream(folder / "table.toml") << "[uinput]\nenabled = true\n";
    expect_refused(touchstone_run({"--sensor", "sim:flat", "--config", (folder / "table.toml").string()}), 69,
                   AllOf(HasSubstr("/dev/uinput"), HasSubstr("sudo "), HasSubstr("[uinput] enabled")));
}

TEST(BadInput, UnknownSceneOrKeyOfTheSimulator) {
    expect_refused(touchstone_run({"--sensor", "sim:moon"}), 64, HasSubstr("moon"));
    expect_refused(touchstone_run({"--sensor", "sim:flat?hands=9"}), 64, HasSubstr("hands"));
}

TEST(BadInput, SourceInTheConfigurationThatIsNone) {
    const TemporaryFolder folder;
    const std::string file = (folder / "table.toml").string();
    std::ofstream(file) << "[sensor]\nuri = \"sim:moon\"\n";
    expect_refused(touchstone_run({"--config", file}), 78,
                   AllOf(HasSubstr(file + ":2: sensor.uri: "), HasSubstr("moon")));
    std::ofstream(file) << "[sensor]\nuri = \"simm:flat\"\n";
    expect_refused(touchstone_run({"--config", file}), 69,
                   AllOf(HasSubstr(file + ":2: sensor.uri: "), HasSubstr("sim:SCENE")));
    expect_refused(touchstone_run({"--config", file, "--sensor", "sim:sun"}), 64,
                   AllOf(HasSubstr("sun"), Not(HasSubstr(file))));
}

TEST(BadInput, NoOpenClDevice) {
    const TemporaryFolder empty;
    expect_refused(touchstone_run({"--sensor", "sim:flat"}, {{"OCL_ICD_VENDORS", empty.path().string()}}), 69,
                   AllOf(HasSubstr("OpenCL"), HasSubstr("install")));
}

TEST(BadInput, OpenClDeviceThatIsNotThere) {
    const TemporaryFolder folder;
    std::ofstream(folder / "table.toml") << "[compute]\ndevice = \"Quantum 9000\"\n";
    expect_refused(touchstone_run({"--sensor", "sim:flat", "--config", (folder / "table.toml").string()}), 69,
                   AllOf(HasSubstr("Quantum 9000"), HasSubstr("there is:")));
}

TEST(BadInput, NoEgl) {
    const TemporaryFolder empty;
    expect_refused(
        touchstone_run({"--sensor", "sim:flat"}, {{"__EGL_VENDOR_LIBRARY_DIRS", empty.path().string()}}), 69,
        HasSubstr("EGL"));
}

TEST(BadInput, NoDesktopForAWindow) {
    expect_refused(run_program({TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat", "--display", "window"},
                               {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}, {"SDL_VIDEODRIVER", "x11"}}),
                   69, HasSubstr("--display headless"));
}

TEST(BadInput, OutputThatCannotBeWritten) {
    expect_refused(touchstone_run({"--sensor", "sim:flat", "--events", "/nowhere/events.jsonl"}), 74,
                   HasSubstr("/nowhere/events.jsonl"));
    expect_refused(
        touchstone_run({"--sensor", "sim:flat", "--pace", "step", "--frames", "3", "--events", "/dev/full"}),
        74, HasSubstr("/dev/full"));
    expect_refused(touchstone_run({"--sensor", "sim:flat", "--shots", "/proc/nowhere"}), 74,
                   HasSubstr("/proc/nowhere"));
}

TEST(BadInput, UnknownOption) { expect_refused(touchstone_run({"--speed", "9"}), 64, HasSubstr("--speed")); }

}  // namespace
}  // namespace touchstone
