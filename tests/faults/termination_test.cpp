// SIGTERM in each state of the table: it ends by itself, with 0, in time, and what it keeps is whole.
#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/scan_file.hpp"
#include "tests/faults/kept_things.hpp"
#include "tests/faults/table_program.hpp"

namespace touchstone {
namespace {

using namespace test;
using testing::HasSubstr;

/// As systemd's TimeoutStopSec, far above what it takes.
constexpr std::chrono::seconds in_time{10};

/// The answer of the system where the program has not come to its first line yet.
bool ended_before_it_began(const ProgramResult& result) {
    return result.status == 128 + SIGTERM && result.err.empty();
}

enum class Begun { yes, perhaps };

void expect_good_end(RunningProgram& program, const TableFolder& folder, Begun begun = Begun::yes) {
    const auto begin = std::chrono::steady_clock::now();
    const ProgramResult result = program.finish(SIGTERM);
    if (begun == Begun::yes || !ended_before_it_began(result)) {
        EXPECT_EQ(result.status, 0) << result.err;
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, in_time) << result.err;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_NE(entry.path().extension(), ".new") << entry.path();
    if (std::filesystem::exists(folder / "table.scan")) {
        EXPECT_NO_THROW((void)load_scan(folder / "table.scan"));
    }
}

TEST(Termination, WhileItStartsWithoutACamera) {
    const TableFolder folder;
    // No USB camera: a machine that has one is in another state, which ends as well.
    RunningProgram program(folder.command(""));
    ASSERT_TRUE(
        comes_true([&] { return program.errors_so_far().find("computing on") != std::string::npos; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    expect_good_end(program, folder);
}

/// In the first second of its life, kernels and all.
TEST(Termination, WhileItStarts) {
    const int starts = times(4, 60);
    for (int i = 0; i < starts; ++i) {
        const TableFolder folder;
        RunningProgram program(folder.command("sim:flat?hands=1&seed=3"));
        std::this_thread::sleep_for(std::chrono::milliseconds(60 + 900 * i / starts));
        expect_good_end(program, folder, Begun::perhaps);
    }
}

TEST(Termination, WhileItScans) {
    const TableFolder folder("frames = 1000\n");
    RunningProgram program(folder.command("sim:flat?hands=2&seed=3&empty=0"));
    ASSERT_TRUE(folder.comes_to("scanning")) << program.errors_so_far();
    expect_good_end(program, folder);
}

TEST(Termination, WhileItIsLive) {
    const TableFolder folder;
    RunningProgram program(folder.command("sim:flat?hands=2&seed=3"));
    ASSERT_TRUE(folder.comes_to("live")) << program.errors_so_far();
    expect_good_end(program, folder);
    EXPECT_TRUE(std::filesystem::exists(folder / "table.scan"));
}

/// A knock that cannot be undone: it looks for its pose for long.
TEST(Termination, WhileItRealigns) {
    const TableFolder folder;
    RunningProgram program(folder.command("sim:cluttered?hands=0&seed=3&knock_s=5&knock_deg=10&knock_mm=80"));
    ASSERT_TRUE(folder.comes_to("realigning")) << program.errors_so_far();
    expect_good_end(program, folder);
}

TEST(Termination, WhileTheSensorIsLost) {
    const TableFolder folder;
    RunningProgram program(folder.command("sim:flat?hands=0&seed=3&unplug_at=2&fault_s=600"));
    ASSERT_TRUE(
        comes_true([&] { return program.errors_so_far().find("was unplugged") != std::string::npos; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    expect_good_end(program, folder);
}

}  // namespace
}  // namespace touchstone
