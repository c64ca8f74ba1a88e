#include "tests/accuracy/recovery_run.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace touchstone {

namespace {

using Clock = std::chrono::steady_clock;

/// The program with its standard output in a pipe and its standard error in a file.
class WatchedProgram {
  public:
    explicit WatchedProgram(std::vector<std::string> command) {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
        child_ = fork();
        if (child_ == 0) {
            dup2(ends[1], STDOUT_FILENO);
            dup2(open(errors().c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), STDERR_FILENO);
            std::vector<char*> arguments;
            for (std::string& word : command) arguments.push_back(word.data());
            arguments.push_back(nullptr);
            execv(arguments[0], arguments.data());
            _exit(127);
        }
        close(ends[1]);
        output_ = ends[0];
    }
    WatchedProgram(const WatchedProgram&) = delete;
    WatchedProgram& operator=(const WatchedProgram&) = delete;
    ~WatchedProgram() {
        if (child_ > 0) (void)end(SIGKILL);
        close(output_);
    }

    /// The next line of its output. Throws where it ends or is silent for a minute.
    std::string line() {
        while (true) {
            const std::size_t end = text_.find('\n');
            if (end != std::string::npos) {
                std::string result = text_.substr(0, end);
                text_.erase(0, end + 1);
                return result;
            }
            pollfd ready{output_, POLLIN, 0};
            std::array<char, 65536> bytes{};
            const ssize_t count = poll(&ready, 1, 60'000) > 0 ? read(output_, bytes.data(), bytes.size()) : 0;
            if (count <= 0) throw std::runtime_error("the program ended or is silent: " + log());
            text_.append(bytes.data(), static_cast<std::size_t>(count));
        }
    }
    std::string log() const {
        std::ostringstream text;
        text << std::ifstream(errors()).rdbuf();
        return text.str();
    }
    double resident_mb() const {
        double all = 0.0, resident = 0.0;
        std::ifstream(fmt::format("/proc/{}/statm", child_)) >> all >> resident;
        return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
    }
    int open_files() const {
        const std::filesystem::directory_iterator files(fmt::format("/proc/{}/fd", child_));
        return static_cast<int>(std::distance(begin(files), std::filesystem::directory_iterator()));
    }
    int end(int signal) {
        kill(child_, signal);
        int status = 0;
        waitpid(child_, &status, 0);
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    std::string errors() const { return (folder_.path() / "log").string(); }

    TemporaryFolder folder_;
    pid_t child_ = -1;
    int output_ = -1;
    std::string text_;
};

int count_of(std::string_view text, std::string_view words) {
    int count = 0;
    for (std::size_t at = text.find(words); at != std::string_view::npos; at = text.find(words, at + 1))
        ++count;
    return count;
}

/// As the log tells them.
int faults_in(const std::string& log) {
    int faults = 0;
    for (const char* words : {"was unplugged", "gives no pictures", "same picture again", "half of a picture",
                              "its clock has jumped"})
        faults += count_of(log, words);
    return faults;
}

/// Touches of one frame after the other.
class TouchWatch {
  public:
    explicit TouchWatch(RecoveryScore& score) : score_(&score) {}

    void take(const nlohmann::json& line) {
        std::set<int> listed;
        for (const auto& touch : line["touches"]) {
            const int id = touch["id"].get<int>();
            const bool was_down = down_.contains(id), goes_down = touch["phase"] == "down";
            listed.insert(id);
            score_->downs += goes_down;
            score_->confused_events += was_down == goes_down;
            if (goes_down) down_.insert(id);
            if (touch["phase"] == "up") down_.erase(id);
        }
        const auto is_left = [&](int id) { return !listed.contains(id); };
        score_->left_touches += static_cast<int>(std::ranges::count_if(down_, is_left));
        std::erase_if(down_, is_left);
    }

  private:
    RecoveryScore* score_;
    std::set<int> down_;
};

}  // namespace

RecoveryScore run_recovery(const RecoveryRun& run) {
    WatchedProgram program({run.program, "run", "--sensor",
                            fmt::format("sim:flat?hands={}&empty=1&seed={}&faults_every={}&fault_s={}",
                                        run.hands, run.seed, run.every_s, run.fault_s),
                            "--pace", "live", "--display", "headless", "--events", "-"});
    RecoveryScore score;
    TouchWatch touches(score);
    auto start = Clock::now(), last = start;
    while (score.faults < run.faults) {
        touches.take(nlohmann::json::parse(program.line()));
        const auto now = Clock::now();
        const std::chrono::duration<double> gap = now - last, all = now - start;
        if (score.frames++ == 0) start = now;  // what came before is its start, not a gap
        if (score.frames > 1) score.longest_gap_s = std::max(score.longest_gap_s, gap.count());
        score.seconds = all.count();
        last = now;
        score.faults = faults_in(program.log());
        if (score.early_files == 0 && score.faults >= run.faults / 10) {
            score.early_mb = program.resident_mb();
            score.early_files = program.open_files();
        }
    }
    score.late_mb = program.resident_mb();
    score.late_files = program.open_files();
    score.restarts =
        count_of(program.log(), "restarting its stream") + count_of(program.log(), "opening it anew");
    score.exit_status = program.end(SIGTERM);
    return score;
}

}  // namespace touchstone
