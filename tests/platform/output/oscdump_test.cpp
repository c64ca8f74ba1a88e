// What an independent OSC program, oscdump of liblo-tools, reads from our datagrams.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>

#include "platform/output/tuio_sink.hpp"
#include "platform/output/udp_channel.hpp"
#include "tests/platform/output/udp_receiver.hpp"

namespace touchstone {
namespace {

using std::chrono::milliseconds;

bool is_listening(int port) {
    std::ostringstream pattern;
    pattern << ':' << std::hex << std::uppercase << port << ' ';
    for (const char* table : {"/proc/net/udp", "/proc/net/udp6"}) {
        std::ifstream file(table);
        for (std::string line; std::getline(file, line);) {
            if (line.find(pattern.str()) != std::string::npos) return true;
        }
    }
    return false;
}

/// oscdump on a port, writing to a file, from its making to its end.
class OscDump {
  public:
    static bool is_installed() { return std::system("command -v oscdump >/dev/null") == 0; }

    explicit OscDump(int port)
        : file_(testing::TempDir() + "oscdump_" + std::to_string(port)), pid_(::fork()) {
        if (pid_ == 0) {
            if (!std::freopen(file_.c_str(), "w", stdout)) ::_exit(127);
            ::execlp("oscdump", "oscdump", "-L", std::to_string(port).c_str(), nullptr);
            ::_exit(127);
        }
        for (int i = 0; i < 250 && !is_listening(port); ++i) std::this_thread::sleep_for(milliseconds(20));
    }
    ~OscDump() {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
        std::filesystem::remove(file_);
    }
    OscDump(const OscDump&) = delete;
    OscDump& operator=(const OscDump&) = delete;

    /// Waits until so many lines are there, five seconds at most; without their time tags.
    std::vector<std::string> lines(std::size_t count) const {
        std::vector<std::string> lines;
        for (int i = 0; i < 250 && lines.size() < count; ++i) {
            std::this_thread::sleep_for(milliseconds(20));
            lines.clear();
            std::ifstream file(file_);
            for (std::string line; std::getline(file, line);)
                lines.push_back(line.substr(line.find(' ') + 1));
        }
        return lines;
    }

  private:
    std::string file_;
    pid_t pid_;
};

TEST(OscDumpReads, EveryMessageOfATapInOrderAndWithItsTypes) {
    if (!OscDump::is_installed()) GTEST_SKIP() << "oscdump (liblo-tools) is not installed";
    int port = 0;
    { port = UdpReceiver().port(); }
    const OscDump dump(port);
    {
        TuioSink sink(std::make_unique<UdpChannel>("127.0.0.1", port), "table@127.0.0.1");
        TouchReport report;
        const ReportedFinger touch{.id = 1, .surface = {0.25, 0.75}};
        report.touches = {touch};
        sink.publish(report);
    }
    using testing::ElementsAre, testing::StrEq, testing::MatchesRegex;
    const auto source = StrEq(R"(/tuio/2Dcur ss "source" "table@127.0.0.1")");
    const auto empty = StrEq(R"(/tuio/2Dcur s "alive")");
    const auto again = StrEq(R"(/tuio/2Dcur si "fseq" -1)");
    const auto count = MatchesRegex(R"(/tuio/2Dcur si "fseq" [0-9]+)");
    const auto alive = MatchesRegex(R"(/tuio/2Dcur si "alive" [0-9]+)");
    const auto set = MatchesRegex(R"(/tuio/2Dcur sifffff "set" [0-9]+ 0.250000 0.750000 0.0+ 0.0+ 0.0+)");
    const auto lines = dump.lines(23);
    ASSERT_THAT(lines, testing::SizeIs(23));
    EXPECT_THAT(std::vector(lines.begin(), lines.begin() + 9),
                ElementsAre(source, empty, again, source, empty, count, source, empty, count));
    EXPECT_THAT(std::vector(lines.begin() + 9, lines.begin() + 17),
                ElementsAre(source, alive, set, count, source, alive, set, again));
    EXPECT_THAT(std::vector(lines.begin() + 17, lines.end()),
                ElementsAre(source, empty, count, source, empty, again));
}

TEST(OscDumpReads, AHoverThatTouchesAsOneCursorOf25Dcur) {
    if (!OscDump::is_installed()) GTEST_SKIP() << "oscdump (liblo-tools) is not installed";
    int port = 0;
    { port = UdpReceiver().port(); }
    const OscDump dump(port);
    {
        TuioSink sink(std::make_unique<UdpChannel>("127.0.0.1", port), "table@127.0.0.1", 150.0);
        TouchReport report;
        report.hovers = {{.id = 1, .surface = {0.25, 0.75}, .height_mm = 75.0}};
        sink.publish(report);
        report.touches = std::exchange(report.hovers, {});
        report.time_us = 500'000;
        sink.publish(report);
    }
    const auto lines = dump.lines(23);
    ASSERT_THAT(lines, testing::SizeIs(23));
    EXPECT_THAT(lines, testing::Each(testing::StartsWith("/tuio/25Dcur ")));
    using testing::MatchesRegex;
    EXPECT_THAT(lines[11],
                MatchesRegex(R"(/tuio/25Dcur sifffffff "set" [0-9]+ 0.25\S* 0.75\S* 0.5\S*( 0.0+){4})"));
    EXPECT_THAT(lines[15],
                MatchesRegex(R"(/tuio/25Dcur sifffffff "set" [0-9]+ 0.25\S* 0.75\S*( 0.0+){3} -1.0+ 2.0+)"));
    const auto session_of = [](const std::string& line) {
        const std::size_t begin = line.find("\"set\" ") + 6;
        return line.substr(begin, line.find(' ', begin) - begin);
    };
    EXPECT_EQ(session_of(lines[11]), session_of(lines[15]));
}

}  // namespace
}  // namespace touchstone
