// The program on a projector that an X server makes up.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/image/png_file.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::HasSubstr;

class ProjectorRun : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v xvfb-run >/dev/null") != 0)
            GTEST_SKIP() << "xvfb-run is not installed (package xvfb)";
    }

    ProgramResult run(const std::string& display_section, std::vector<std::string> more = {}) {
        std::ofstream(folder_ / "config.toml") << "[display]\n" << display_section;
        std::vector<std::string> command{"/usr/bin/env", "xvfb-run", "-a", "-s", "-screen 0 800x600x24"};
        command.insert(command.end(),
                       {TOUCHSTONE_PROGRAM, "run", "--display", "projector", "--sensor", "sim:flat?hands=0",
                        "--voxels", "64", "--config", (folder_ / "config.toml").string()});
        command.insert(command.end(), more.begin(), more.end());
        return run_program(command, {{"SDL_VIDEODRIVER", "x11"}});
    }

    TemporaryFolder folder_;
};

TEST_F(ProjectorRun, FillsTheOutput) {
    const ProgramResult result = run("output = \"screen\"\nmode = \"800x600\"\n",
                                     {"--pace", "step", "--frames", "5", "--shots", folder_.path().string()});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("showing on screen"));
    const Image8 shot = read_png_8(folder_ / "frame-000004.png");
    EXPECT_EQ(shot.width_px, 800);
    EXPECT_EQ(shot.height_px, 600);
}

/// xvfb-run shows standard error among what the program prints.
TEST_F(ProjectorRun, WhatIsNotThereIsSaid) {
    const ProgramResult output = run("output = \"HDMI-A-7\"\n");
    EXPECT_EQ(output.status, 69);
    EXPECT_THAT(output.out + output.err, HasSubstr("HDMI-A-7"));
    const ProgramResult mode = run("mode = \"333x222@10\"\n");
    EXPECT_EQ(mode.status, 78);
    EXPECT_THAT(mode.out + mode.err, HasSubstr("it has 800x600"));
}

TEST(ProjectorRunOnAConsole, WithoutAGraphicsCardSaysSo) {
    if (std::filesystem::exists("/dev/dri/card0")) GTEST_SKIP() << "this machine has a graphics card";
    const ProgramResult result = run_program({"/usr/bin/env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", "-u",
                                              "SDL_VIDEODRIVER", TOUCHSTONE_PROGRAM, "run", "--display",
                                              "projector", "--sensor", "sim:flat", "--voxels", "64"});
    EXPECT_EQ(result.status, 69);
    EXPECT_THAT(result.err, HasSubstr("No projector: there is no /dev/dri/card*"));
}

}  // namespace
}  // namespace touchstone
