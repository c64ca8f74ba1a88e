#pragma once

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace touchstone::test {

struct ProgramResult {
    int status = -1;  ///< exit status; 128 + signal where one ended it
    std::string out, err;
};

/// A program started with its own standard output and error, ended at the latest with this object.
class RunningProgram {
  public:
    using Environment = std::vector<std::pair<std::string, std::string>>;

    RunningProgram(std::vector<std::string> command, const Environment& environment = {}) {
        child_ = fork();
        if (child_ == 0) become(command, environment);
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;
    ~RunningProgram() {
        if (child_ > 0) finish(SIGKILL);
    }

    /// Waits for its end; `signal` other than 0 is sent first.
    ProgramResult finish(int signal = 0) {
        if (signal != 0) kill(child_, signal);
        int status = 0;
        waitpid(child_, &status, 0);
        child_ = -1;
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return {code, text("out"), text("err")};
    }

    pid_t pid() const { return child_; }
    /// Where its standard output goes.
    std::filesystem::path output_file() const { return folder_.path() / "out"; }
    /// What it has written to standard error up to now.
    std::string errors_so_far() const { return text("err"); }

  private:
    [[noreturn]] void become(std::vector<std::string>& command, const Environment& environment) {
        for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
        redirect("out", STDOUT_FILENO);
        redirect("err", STDERR_FILENO);
        std::vector<char*> arguments;
        for (std::string& word : command) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    void redirect(const char* name, int target) {
        const int file = open((folder_.path() / name).c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
        dup2(file, target);
    }
    std::string text(const char* name) const {
        std::ifstream file(folder_.path() / name);
        std::ostringstream content;
        content << file.rdbuf();
        return content.str();
    }

    TemporaryFolder folder_;
    pid_t child_ = -1;
};

inline ProgramResult run_program(std::vector<std::string> command,
                                 const RunningProgram::Environment& environment = {}) {
    return RunningProgram(std::move(command), environment).finish();
}

}  // namespace touchstone::test
