#pragma once

#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "platform/system/process_memory.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone::test {

/// A running program whose standard output is read line by line.
class WatchedProgram {
  public:
    explicit WatchedProgram(std::vector<std::string> command) : program_(std::move(command)) {}

    /// The next line of its output. Throws where it is silent for a minute.
    std::string line() {
        using Clock = std::chrono::steady_clock;
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
    RunningProgram program_;
    std::ifstream output_;
};

inline int count_of(std::string_view text, std::string_view words) {
    int count = 0;
    for (std::size_t at = text.find(words); at != std::string_view::npos; at = text.find(words, at + 1))
        ++count;
    return count;
}

/// Faults of a simulated camera, as the log tells them.
inline int faults_in(std::string_view log) {
    int faults = 0;
    for (const char* words : {"was unplugged", "gives no pictures", "same picture again", "half of a picture",
                              "its clock has jumped"})
        faults += count_of(log, words);
    return faults;
}

/// Restarts of its stream, and times it was opened anew.
inline int restarts_in(std::string_view log) {
    return count_of(log, "restarting its stream") + count_of(log, "opening it anew");
}

}  // namespace touchstone::test
