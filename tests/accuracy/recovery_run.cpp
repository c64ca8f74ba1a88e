#include "tests/accuracy/recovery_run.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include "platform/system/process_memory.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {

namespace {

using Clock = std::chrono::steady_clock;

/// The program, line by line.
class WatchedProgram {
  public:
    explicit WatchedProgram(std::vector<std::string> command) : program_(std::move(command)) {}

    /// The next line of its output. Throws where it is silent for a minute.
    std::string line() {
        const auto deadline = Clock::now() + std::chrono::minutes(1);
        while (Clock::now() < deadline) {
            if (!output_.is_open()) output_.open(program_.output_file());
            const auto place = output_.tellg();
            std::string line;
            if (std::getline(output_, line) && !output_.eof()) return line;
            output_.clear();
            output_.seekg(place);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        throw std::runtime_error("the program ended or is silent: " + log());
    }
    std::string log() const { return program_.errors_so_far(); }
    double resident_mb() const { return touchstone::resident_mb(std::to_string(program_.pid())); }
    int open_files() const {
        const std::filesystem::directory_iterator files(fmt::format("/proc/{}/fd", program_.pid()));
        return static_cast<int>(std::distance(begin(files), std::filesystem::directory_iterator()));
    }
    int end() { return program_.finish(SIGTERM).status; }

  private:
    test::RunningProgram program_;
    std::ifstream output_;
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
    score.exit_status = program.end();
    return score;
}

}  // namespace touchstone
