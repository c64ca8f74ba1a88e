#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/platform/usb/emulated_usb.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using test::ProgramResult;
using test::run_program;
using test::RunningProgram;
using ::testing::HasSubstr;

/// The program on a machine whose USB is made up.
class CheckCommandTest : public ::testing::Test {
  protected:
    void SetUp() override {
        usb = std::make_unique<EmulatedUsb>();
        if (!EmulatedUsb::works()) GTEST_SKIP() << "needs umockdev's library preloaded: umockdev-wrapper";
    }
    static std::string status_of(const std::string& subject, const nlohmann::json& page) {
        for (const auto& line : page["checks"])
            if (line["subject"] == subject) return line["status"];
        return "none";
    }

    std::unique_ptr<EmulatedUsb> usb;
};

TEST_F(CheckCommandTest, SaysWhatIsPluggedInAndFailsWithoutACamera) {
    const ProgramResult result = run_program({TOUCHSTONE_PROGRAM, "check", "--json"});
    const auto page = nlohmann::json::parse(result.out);
    EXPECT_EQ(result.status, 69);
    EXPECT_EQ(page["status"], "fail");
    EXPECT_EQ(status_of("sensor", page), "fail");
    for (const char* subject : {"drivers", "OpenCL device", "drawing", "configuration"})
        EXPECT_EQ(status_of(subject, page), "ok") << subject;
    for (const char* subject : {"speed", "outputs", "service", "disk"})
        EXPECT_NE(status_of(subject, page), "none") << subject;
    for (const auto& line : page["checks"])
        EXPECT_EQ(line["status"] == "ok", line["advice"] == "") << line["subject"];
}

TEST_F(CheckCommandTest, UinputIsCheckedWhereItIsWanted) {
    const TemporaryFolder folder;
    const std::string file = (folder / "table.toml").string();
    const auto check = [&] {
        return nlohmann::json::parse(
            run_program({TOUCHSTONE_PROGRAM, "check", "--json", "--config", file}).out);
    };
    std::ofstream(file) << "[uinput]\nenabled = false\n";
    EXPECT_EQ(status_of("uinput", check()), "none");
    std::ofstream(file) << "[uinput]\nenabled = true\n";
    EXPECT_NE(status_of("uinput", check()), "none");
}

TEST_F(CheckCommandTest, AKinectPluggedInIsAnnouncedByOurDriver) {
    usb->plug_in_kinect("1-2");
    const auto page = nlohmann::json::parse(run_program({TOUCHSTONE_PROGRAM, "check", "--json"}).out);
    for (const char* subject : {"sensor", "power", "permission", "bandwidth", "drivers"})
        EXPECT_EQ(status_of(subject, page), "ok") << subject << "\n" << page.dump(2);
    EXPECT_EQ(status_of("USB sleep", page), "warn");
}

TEST_F(CheckCommandTest, AKinectWithoutPowerForPeople) {
    usb->plug_in_kinect_without_power("1-2");
    const ProgramResult result = run_program({TOUCHSTONE_PROGRAM, "check"});
    EXPECT_EQ(result.status, 69);
    EXPECT_THAT(result.out, HasSubstr("fail  power"));
    EXPECT_THAT(result.out, HasSubstr("-> plug in its power supply"));
    EXPECT_EQ(result.err, "");
}

/// Waits for a line of the log.
bool says(const RunningProgram& program, const std::string& words) {
    for (int i = 0; i < 600; ++i) {
        if (program.errors_so_far().find(words) != std::string::npos) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

TEST_F(CheckCommandTest, TheTableSaysWhatItWaitsForAsThingsChange) {
    RunningProgram program({TOUCHSTONE_PROGRAM, "run", "--display", "headless"});
    EXPECT_TRUE(says(program, "waiting for one to be plugged in"));
    usb->plug_in_kinect_without_power("1-2");
    EXPECT_TRUE(says(program, "plug in its power supply")) << program.errors_so_far();
    EXPECT_EQ(program.finish(SIGTERM).status, 0);
}

TEST_F(CheckCommandTest, ABadConfigurationIsALine) {
    const ProgramResult result = run_program({TOUCHSTONE_PROGRAM, "check", "--config", "/nowhere.toml"});
    EXPECT_EQ(result.status, 78);
    EXPECT_THAT(result.out, HasSubstr("fail  configuration"));
    EXPECT_THAT(result.out, HasSubstr("warn  sensor         not looked for")) << "it may be named there";
}

}  // namespace
}  // namespace touchstone
