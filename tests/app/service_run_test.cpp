// The program as systemd would start it: what comes on the socket that it names.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/notify_socket.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using namespace std::chrono_literals;
using test::RunningProgram;
using testing::Contains;
using testing::StartsWith;

using Messages = std::vector<std::string>;

std::ptrdiff_t count(const Messages& messages, const std::string& message) {
    return std::ranges::count(messages, message);
}

class ServiceRun : public testing::Test {
  protected:
    RunningProgram::Environment service() const {
        return {{"NOTIFY_SOCKET", (folder_ / "notify").string()},
                {"WATCHDOG_USEC", "400000"},
                {"STATE_DIRECTORY", folder_.path().string()}};
    }
    static auto has(const std::string& message) {
        return [message](const Messages& messages) { return count(messages, message) > 0; };
    }

    TemporaryFolder folder_;
    test::NotifySocket socket_{folder_ / "notify"};
};

TEST_F(ServiceRun, IsReadyOnceAFrameWentThroughAndFedByFrames) {
    RunningProgram table({TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat?hands=0", "--display", "headless"},
                         service());
    const Messages start = socket_.read(60s, has("STATUS=live"));
    EXPECT_EQ(count(start, "READY=1"), 1);
    EXPECT_THAT(start, Contains("STATUS=scanning"));
    const Messages later = socket_.read(60s, [](const Messages& m) { return count(m, "WATCHDOG=1") >= 3; });
    EXPECT_GE(count(later, "WATCHDOG=1"), 3);
    EXPECT_EQ(count(later, "READY=1"), 0);
    EXPECT_EQ(table.finish(SIGTERM).status, 0);
    EXPECT_THAT(socket_.read(10ms), Contains("STOPPING=1"));
}

/// There is none on the machines that test.
TEST_F(ServiceRun, IsGivenTimeWhileItWaitsForACamera) {
    RunningProgram table({TOUCHSTONE_PROGRAM, "run", "--display", "headless"}, service());
    const Messages waiting = socket_.read(60s, [](const Messages& m) { return count(m, "WATCHDOG=1") >= 2; });
    if (count(waiting, "READY=1") > 0) GTEST_SKIP() << "a depth camera is attached";
    EXPECT_THAT(waiting, Contains(StartsWith("EXTEND_TIMEOUT_USEC=")));
    EXPECT_THAT(waiting, Contains(StartsWith("STATUS=starting: ")));
    EXPECT_EQ(table.finish(SIGTERM).status, 0);
}

/// Events that nobody reads any more stop the loop when the pipe is full.
TEST_F(ServiceRun, AHangOfThePerceptionLoopStarvesTheWatchdog) {
    const std::string pipe = (folder_ / "events").string();
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDWR);
    ASSERT_GE(fcntl(reader, F_SETPIPE_SZ, 4096), 0);
    RunningProgram table({TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat?hands=0", "--display", "headless",
                          "--events", pipe},
                         service());
    ASSERT_THAT(socket_.read(60s, has("READY=1")), Contains("READY=1"));
    // Forty lines or so until it is full; a busy machine may take its time for them.
    bool starved = false;
    for (int i = 0; i < 30 && !starved; ++i) starved = count(socket_.read(1500ms), "WATCHDOG=1") == 0;
    EXPECT_TRUE(starved);
    close(reader);
    table.finish(SIGKILL);
}

TEST_F(ServiceRun, WhyItFailedIsKeptForTheFallbackScreenUntilTheNextStart) {
    const std::filesystem::path note = folder_ / "last-failure";
    RunningProgram failing({TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:nowhere"}, service());
    EXPECT_EQ(failing.finish().status, 64);
    std::ifstream file(note);
    std::string reason;
    std::getline(file, reason);
    EXPECT_THAT(reason, testing::HasSubstr("nowhere"));
    RunningProgram notice(
        {TOUCHSTONE_PROGRAM, "notice", "The table rests.", "--display", "headless", "--seconds", "0.3"},
        service());
    const test::ProgramResult shown = notice.finish();
    EXPECT_EQ(shown.status, 0) << shown.err;
    EXPECT_THAT(shown.err, testing::HasSubstr("The table rests."));
    EXPECT_THAT(shown.err, testing::HasSubstr("nowhere"));
    RunningProgram fine(
        {TOUCHSTONE_PROGRAM, "run", "--sensor", "sim:flat?hands=0", "--display", "headless", "--frames", "1"},
        service());
    EXPECT_EQ(fine.finish().status, 0);
    EXPECT_FALSE(std::filesystem::exists(note));
}

TEST_F(ServiceRun, AResetForgetsWhatTheTableWroteAndKeepsTheRest) {
    const auto write = [&](const std::string& name) { std::ofstream(folder_ / name) << "x"; };
    for (const char* name : {"table.scan", "finger.bias", "beamer", "painting", "painting.of-left", "areas",
                             "paintings", "other"})
        write(name);
    for (const char* name :
         {"table.scan.previous", "finger.bias.previous", "beamer.previous", "painting.previous",
          "painting.new", "table.scan.previous.new", "painting.of-left.previous", "areas.previous"})
        write(name);
    std::filesystem::create_directories(folder_ / "faults/fault-20260101-000000-frozen");
    write("faults/fault-20260101-000000-frozen/frame");
    write("faults/note");
    const auto at = [&](const char* name) {
        std::string quoted(1, '"');
        return quoted.append((folder_ / name).string()).append("\"\n");
    };
    std::ofstream(folder_ / "table.toml")
        << "[scan]\nfile = " << at("table.scan") << "[touch]\nbias_file = " << at("finger.bias")
        << "[projector]\nfile = " << at("beamer") << "[display]\npainting_file = " << at("painting")
        << "[areas]\nfile = " << at("areas") << "[health]\nfault_dir = " << at("faults");
    const std::vector<std::string> reset{TOUCHSTONE_PROGRAM, "reset", "--config",
                                         (folder_ / "table.toml").string()};
    const test::ProgramResult result = test::run_program(reset);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(std::ranges::count(result.out, '\n'), 15) << result.out;
    std::vector<std::string> left;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
        if (entry.is_regular_file()) left.push_back(entry.path().filename().string());
    EXPECT_THAT(left, testing::UnorderedElementsAre("other", "paintings", "note", "table.toml"));
    EXPECT_EQ(test::run_program(reset).out, "nothing to remove\n");
}

}  // namespace
}  // namespace touchstone
