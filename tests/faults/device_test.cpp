// What the program computes and draws with fails, and the clock is set back (preload/).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/scan_file.hpp"
#include "tests/faults/table_program.hpp"
#include "tests/support/watched_program.hpp"

namespace touchstone {
namespace {

using namespace test;
using testing::HasSubstr;

class Device : public testing::Test {
  protected:
    RunningProgram start(const std::string& module, const std::string& sensor,
                         const std::vector<std::string>& more = {}) const {
        return RunningProgram(folder_.command(sensor, more),
                              {{"LD_PRELOAD", fmt::format("{}{}/lib{}.so", TOUCHSTONE_PRELOAD_FIRST,
                                                          TOUCHSTONE_PRELOADS, module)},
                               {"TOUCHSTONE_FAULT_SWITCH", (folder_ / "fault").string()}});
    }
    void fail() const { std::ofstream(folder_ / "fault") << "now"; }
    bool goes_on_for(int frames) const {
        const int before = folder_.events();
        return comes_true([&] { return folder_.events() >= before + frames; });
    }

    TableFolder folder_;
};

/// The driver's state in the process is not to be trusted after that: the service starts it anew, and the
/// scan is there.
TEST_F(Device, OpenClThatIsLostEndsTheProgramForTheServiceToStartItAgain) {
    RunningProgram program = start("lost_opencl_device", "sim:flat?hands=2&seed=3");
    ASSERT_TRUE(folder_.comes_to("live")) << program.errors_so_far();
    ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(folder_ / "table.scan"); }));
    fail();
    const ProgramResult result = program.finish();
    EXPECT_EQ(result.status, 69) << result.err;
    EXPECT_EQ(count_of(result.err, "\ntouchstone: "), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("CL_OUT_OF_RESOURCES"));
    EXPECT_NO_THROW((void)load_scan(folder_ / "table.scan"));
    std::filesystem::remove(folder_ / "fault");
    const ProgramResult again =
        run_program(folder_.command("sim:flat?hands=0&seed=3", {"--frames", "60", "--pace", "step"}));
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_THAT(again.err, HasSubstr("the saved scan fits"));
}

TEST_F(Device, AGlContextThatIsLostIsMadeAnewAndTouchesGoOn) {
    RunningProgram program = start("lost_gl_context", "sim:flat?hands=2&seed=3");
    ASSERT_TRUE(folder_.comes_to("live")) << program.errors_so_far();
    fail();
    EXPECT_TRUE(comes_true([&] {
        return program.errors_so_far().find("the display is back") != std::string::npos;
    })) << program.errors_so_far();
    EXPECT_TRUE(goes_on_for(20));
    const ProgramResult result = program.finish(SIGTERM);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(count_of(result.err, "the display is lost"), 1) << result.err;
}

/// By a day, as a board without a clock of its own does when it reaches the network. Frames, their times and
/// their touches go on.
TEST_F(Device, AClockThatIsSetBackHoldsUpNothing) {
    RunningProgram program = start("clock_set_back", "sim:flat?hands=2&seed=3");
    ASSERT_TRUE(folder_.comes_to("live")) << program.errors_so_far();
    const auto before_us = folder_.last_event()["time_us"].get<std::uint64_t>();
    fail();
    EXPECT_TRUE(goes_on_for(60)) << program.errors_so_far();
    EXPECT_GT(folder_.last_event()["time_us"].get<std::uint64_t>(), before_us);
    EXPECT_EQ(folder_.last_event()["state"], "live");
    const ProgramResult result = program.finish(SIGTERM);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(faults_in(result.err), 0) << result.err;
}

}  // namespace
}  // namespace touchstone
