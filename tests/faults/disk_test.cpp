// The program on a disk without room, on one that is read-only, and killed while it saves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "pipeline/scan_file.hpp"
#include "tests/faults/kept_things.hpp"
#include "tests/faults/table_program.hpp"
#include "tests/support/watched_program.hpp"

namespace touchstone {
namespace {

using namespace test;
using testing::HasSubstr;

/// The command with another disk, of its own, in the place of a folder.
std::vector<std::string> on_disk(const std::string& mount, const std::vector<std::string>& command) {
    std::vector<std::string> words{"/usr/bin/unshare", "--user", "--map-root-user",         "--mount",
                                   "/bin/sh",          "-c",     mount + " && exec \"$@\"", "sh"};
    words.insert(words.end(), command.begin(), command.end());
    return words;
}

bool disks_can_be_made() {
    return run_program(on_disk("mount -t tmpfs none /mnt", {"/bin/true"})).status == 0;
}

class Disk : public testing::Test {
  protected:
    void SetUp() override {
        if (!disks_can_be_made()) GTEST_SKIP() << "no namespaces here to mount a disk in";
        std::filesystem::create_directory(state());
        folder_.configure("[tuio]\nenabled = false\n[touch]\nbias_file = \"" + state() + "/touch.bias\"\n",
                          state());
    }
    std::string state() const { return (folder_ / "state").string(); }

    /// Lives through its scan and on, with the disk as it is.
    void expect_a_table_that_works(const std::string& mount, const std::string& reason) {
        const ProgramResult result = run_program(
            on_disk(mount, folder_.command("sim:flat?hands=2&seed=3", {"--frames", "90", "--pace", "step"})));
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(folder_.events(), 90);
        EXPECT_EQ(folder_.last_event()["state"], "live");
        EXPECT_EQ(count_of(result.err, "the scan is not kept"), 1) << "said once: " << result.err;
        EXPECT_THAT(result.err, HasSubstr(state() + "/table.scan"));
        EXPECT_THAT(result.err, HasSubstr(reason));
    }

    TableFolder folder_;
};

TEST_F(Disk, WithoutRoomIsSaidOnceAndTheTableWorks) {
    expect_a_table_that_works("mount -t tmpfs -o size=8k none " + state(), "No space left on device");
}

TEST_F(Disk, ThatIsReadOnlyIsSaidOnceAndTheTableWorks) {
    expect_a_table_that_works("mount -t tmpfs -o ro none " + state(), "Read-only file system");
}

TEST_F(Disk, WhoseFolderIsMissingIsSaidOnceAndTheTableWorks) {
    expect_a_table_that_works("rmdir " + state(), "No such file or directory");
}

/// The scan is there, the disk has become read-only since: a start goes on with it.
TEST_F(Disk, ThatHasBecomeReadOnlyStillGivesTheScan) {
    const std::string sensor = "sim:flat?hands=0&seed=3";
    ASSERT_EQ(run_program(folder_.command(sensor, {"--frames", "60", "--pace", "step"})).status, 0);
    const ProgramResult result = run_program(
        on_disk("mount --bind " + state() + " " + state() + " && mount -o remount,bind,ro " + state(),
                folder_.command(sensor, {"--frames", "60", "--pace", "step"})));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("the saved scan fits"));
}

TEST(Kill, OfTheProgramLeavesAScanWithWhichItStarts) {
    const TableFolder folder;
    std::mt19937 random(4);
    const int kills = times(5, 60);
    for (int i = 0; i < kills; ++i) {
        RunningProgram program(folder.command("sim:flat?hands=2&seed=3"));
        // Half of them just when the scan is written.
        if (i % 2 == 0) {
            ASSERT_TRUE(
                folder.comes_to(std::filesystem::exists(folder / "table.scan") ? "live" : "scanning"));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 700));
        EXPECT_EQ(program.finish(SIGKILL).status, 128 + SIGKILL);
        if (std::filesystem::exists(folder / "table.scan")) {
            ASSERT_NO_THROW((void)load_scan(folder / "table.scan"));
        }
    }
    const ProgramResult result =
        run_program(folder.command("sim:flat?hands=0&seed=3", {"--frames", "40", "--pace", "step"}));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(folder.last_event()["state"], "live");
    EXPECT_TRUE(std::filesystem::exists(folder / "table.scan"));
}

/// All that is kept is damaged at once: a new scan, no picture on the surface, an empty table.
TEST(Damage, OfEverythingThatIsKeptCostsAScan) {
    const TableFolder folder;
    for (const KeptThing& thing : kept_things())
        for (const char* ending : {"", ".previous"})
            std::ofstream(folder / (thing.name + ending)) << "the disk has eaten this";
    const ProgramResult result =
        run_program(folder.command("sim:flat?hands=0&seed=3", {"--frames", "60", "--pace", "step"}));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(folder.last_event()["state"], "live");
    for (const char* name : {"table.scan", "projector.calibration", "table.painting"})
        EXPECT_THAT(result.err, HasSubstr(name));
    EXPECT_NO_THROW((void)load_scan(folder / "table.scan"));
}

}  // namespace
}  // namespace touchstone
